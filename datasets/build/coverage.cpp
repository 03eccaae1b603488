#include "datasets/build/coverage.h"

#include "core/error.h"
#include "datasets/build/stats.h"
#include "faces/principal_components.h"

#include <algorithm>

namespace daumier::datasets {
namespace {

constexpr int kMaxBasisFaces = 600;
constexpr int kCounts[] = {0, 10, 50, 100, 150, 200};
constexpr double kLeastShare = 1e-9;  // Of the largest variance: what is less is rounding.

/// The coordinates of a region's vertices, one after the other.
std::vector<float> RegionOf(const faces::FaceDatabase& database, int face, const std::vector<int>& region) {
  const auto all = database.vertices(face);
  std::vector<float> coordinates;
  coordinates.reserve(3 * region.size());
  for (const int vertex : region) {
    for (int k = 0; k < 3; ++k) coordinates.push_back(all[3 * size_t(vertex) + k]);
  }
  return coordinates;
}

double MeanDistance(const Eigen::VectorXd& difference) {
  const Eigen::Map<const geometry::Points> rows(difference.data(), difference.size() / 3, 3);
  return rows.rowwise().norm().mean();
}

}  // namespace

Coverage MeasureCoverage(const faces::FaceDatabase& basis, const faces::FaceDatabase& rebuilt) {
  DAUMIER_CHECK(basis.num_vertices() == rebuilt.num_vertices(),
                "faces of {} vertices cannot be rebuilt from faces of {}; both databases need one topology",
                rebuilt.num_vertices(), basis.num_vertices());
  const std::vector<int>& region =
      faces::RegionFor(basis.face_template().annotation, "face", "a comparison of databases");
  Coverage coverage;
  const std::vector<int> chosen = SampleFaces(basis, kMaxBasisFaces);
  coverage.num_basis_faces = static_cast<int>(chosen.size());
  std::vector<std::vector<float>> faces;
  for (const int face : chosen) faces.push_back(RegionOf(basis, face, region));
  const auto num_coordinates = static_cast<int>(3 * region.size());
  const auto column = [&](const std::vector<float>& face) -> Eigen::VectorXd {
    return Eigen::Map<const Eigen::VectorXf>(face.data(), num_coordinates).cast<double>();
  };
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(num_coordinates);
  for (const auto& face : faces) mean += column(face) / double(faces.size());
  const Eigen::MatrixXd gram = faces::GramMatrix(
      coverage.num_basis_faces, num_coordinates, [&](int i) { return std::span<const float>(faces[i]); },
      faces::Centring::kMean);
  const int most = std::min(coverage.num_basis_faces, *std::max_element(std::begin(kCounts), std::end(kCounts)));
  const faces::SnapshotComponents found = faces::FindComponents(gram, most, kLeastShare);
  const auto num_components = static_cast<int>(found.variances.size());
  Eigen::MatrixXd components = Eigen::MatrixXd::Zero(num_coordinates, num_components);
  for (size_t i = 0; i < faces.size(); ++i)
    components += (column(faces[i]) - mean) * found.weights.row(Eigen::Index(i));

  for (const int count : kCounts) {
    if (count <= num_components) coverage.components.push_back(count);
  }
  if (coverage.components.back() < num_components) coverage.components.push_back(num_components);
  coverage.errors_mm.assign(coverage.components.size(), 0.0);
  const double mm_per_cm = faces::MillimetresPerCm(basis.face_template());
  for (int face = 0; face < rebuilt.num_faces(); ++face) {
    const Eigen::VectorXd difference = column(RegionOf(rebuilt, face, region)) - mean;
    const Eigen::VectorXd coefficients = components.transpose() * difference;
    for (size_t i = 0; i < coverage.components.size(); ++i) {
      const int count = coverage.components[i];
      coverage.errors_mm[i] += mm_per_cm / rebuilt.num_faces() *
                               MeanDistance(difference - components.leftCols(count) * coefficients.head(count));
    }
  }
  return coverage;
}

}  // namespace daumier::datasets
