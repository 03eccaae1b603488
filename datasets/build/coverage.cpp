#include "datasets/build/coverage.h"

#include "core/error.h"
#include "datasets/build/stats.h"
#include "geometry/symmetric_eigen.h"

#include <algorithm>

namespace daumier::datasets {
namespace {

constexpr int kMaxBasisFaces = 600;
constexpr int kCounts[] = {0, 10, 50, 100, 150, 200};
constexpr double kLeastShare = 1e-9;  // Of the largest variance: what is less is rounding.

/// The coordinates of a region's vertices, next to each other.
Eigen::VectorXd RegionOf(const faces::FaceDatabase& database, int face, const std::vector<int>& region) {
  const auto all = database.vertices(face);
  Eigen::VectorXd coordinates(3 * region.size());
  for (size_t i = 0; i < region.size(); ++i) {
    for (int k = 0; k < 3; ++k) coordinates[Eigen::Index(3 * i) + k] = all[3 * size_t(region[i]) + k];
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
  Eigen::MatrixXd faces(3 * region.size(), coverage.num_basis_faces);  // A column a face.
  for (int i = 0; i < coverage.num_basis_faces; ++i) faces.col(i) = RegionOf(basis, chosen[i], region);
  const Eigen::VectorXd mean = faces.rowwise().mean();
  faces.colwise() -= mean;
  // With F'F = U S U' the columns of F U S^-1/2 are the components.
  const geometry::SymmetricEigen gram = geometry::DecomposeSymmetric(faces.transpose() * faces);
  const Eigen::VectorXd variances = gram.values.reverse();
  const auto rank = static_cast<int>((variances.array() > kLeastShare * variances[0]).count());
  const int num_components = std::min(rank, *std::max_element(std::begin(kCounts), std::end(kCounts)));
  const Eigen::MatrixXd components = faces * gram.vectors.rowwise().reverse().leftCols(num_components) *
                                     variances.head(num_components).cwiseSqrt().cwiseInverse().asDiagonal();

  for (const int count : kCounts) {
    if (count <= num_components) coverage.components.push_back(count);
  }
  if (coverage.components.back() < num_components) coverage.components.push_back(num_components);
  coverage.errors_mm.assign(coverage.components.size(), 0.0);
  const double mm_per_cm = faces::MillimetresPerCm(basis.face_template());
  for (int face = 0; face < rebuilt.num_faces(); ++face) {
    const Eigen::VectorXd difference = RegionOf(rebuilt, face, region) - mean;
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
