#include "faces/face_gaussian.h"

#include "core/error.h"
#include "core/safetensors.h"
#include "faces/principal_components.h"

#include <algorithm>
#include <cmath>

namespace daumier::faces {
namespace {

using Rows = BilinearModel::Core;

/// A component that explains a smaller share than this of the first one's variance is rounding.
constexpr double kLeastGaussianShare = 1e-9;

Eigen::RowVectorXf MirrorImage(const Eigen::RowVectorXf& face, const std::vector<int>& mirror) {
  Eigen::RowVectorXf image(face.size());
  for (size_t v = 0; v < mirror.size(); ++v) {
    const Eigen::Index to = 3 * Eigen::Index(v), from = 3 * Eigen::Index(mirror[v]);
    image.segment<3>(to) << -face[from], face[from + 1], face[from + 2];
  }
  return image;
}

/// sqrt(1/N) U^T X of X X^T = U S U^T, the components of rows X, each as long as its deviation.
Rows ScaledComponents(const Rows& faces, int most) {
  const int num_faces = int(faces.rows());
  if (most == 0) return Rows(0, faces.cols());
  const Eigen::MatrixXd gram = GramMatrix(
      num_faces, int(faces.cols()),
      [&](int i) { return std::span<const float>(faces.row(i).data(), size_t(faces.cols())); }, Centring::kNone);
  if (gram.trace() <= 0) return Rows(0, faces.cols());
  const SnapshotComponents components = FindComponents(gram, std::min(most, num_faces), kLeastGaussianShare);
  const Eigen::VectorXd deviations = (components.variances / num_faces).cwiseSqrt();
  Rows rows = (components.weights * deviations.asDiagonal()).cast<float>().transpose() * faces;
  for (Eigen::Index k = 0; k < rows.rows(); ++k) FixSign(rows.row(k));
  return rows;
}

}  // namespace

FaceGaussian FitFaceGaussian(int num_faces, int num_coordinates, const std::function<std::span<const float>(int)>& face,
                             const std::vector<int>& mirror, const FaceGaussianOptions& options, const Task& task) {
  DAUMIER_CHECK(num_faces > 0, "a distribution of faces needs faces");
  DAUMIER_CHECK(mirror.empty() || 3 * int(mirror.size()) == num_coordinates,
                "a mirror map of {} vertices for faces of {} coordinates", mirror.size(), num_coordinates);
  Rows symmetric(num_faces, num_coordinates), asymmetric(mirror.empty() ? 0 : num_faces, num_coordinates);
  for (int i = 0; i < num_faces; ++i) {
    task.ThrowIfCancelled("stopped while the distribution of faces was fitted; nothing was written");
    const std::span<const float> coordinates = face(i);
    DAUMIER_CHECK(int(coordinates.size()) == num_coordinates, "face {} has {} coordinates, expected {}", i,
                  coordinates.size(), num_coordinates);
    symmetric.row(i) = Eigen::Map<const Eigen::RowVectorXf>(coordinates.data(), num_coordinates);
    if (mirror.empty()) continue;
    const Eigen::RowVectorXf image = MirrorImage(symmetric.row(i), mirror);
    asymmetric.row(i) = (symmetric.row(i) - image) / 2;
    symmetric.row(i) = (symmetric.row(i) + image) / 2;
  }
  FaceGaussian gaussian;
  gaussian.mean = symmetric.cast<double>().colwise().mean().cast<float>().transpose();
  symmetric.rowwise() -= gaussian.mean.transpose();
  const Rows first = ScaledComponents(symmetric, options.num_symmetric);
  const Rows second = mirror.empty() ? Rows(0, num_coordinates) : ScaledComponents(asymmetric, options.num_asymmetric);
  gaussian.num_symmetric = int(first.rows());
  gaussian.rows.resize(first.rows() + second.rows(), num_coordinates);
  gaussian.rows << first, second;
  return gaussian;
}

Eigen::VectorXf CoefficientsOf(const FaceGaussian& gaussian, std::span<const float> face) {
  DAUMIER_CHECK(int(face.size()) == gaussian.num_coordinates(), "a face of {} coordinates, expected {}", face.size(),
                gaussian.num_coordinates());
  const Eigen::VectorXf offset =
      Eigen::Map<const Eigen::VectorXf>(face.data(), Eigen::Index(face.size())) - gaussian.mean;
  return (gaussian.rows * offset).cwiseQuotient(gaussian.rows.rowwise().squaredNorm());
}

Eigen::VectorXf Reconstruct(const FaceGaussian& gaussian, const Eigen::VectorXf& coefficients) {
  DAUMIER_CHECK(coefficients.size() == gaussian.size(), "{} coefficients for {} components", coefficients.size(),
                gaussian.size());
  return gaussian.mean + gaussian.rows.transpose() * coefficients;
}

FaceBasis BasisOf(const FaceGaussian& gaussian) {
  FaceBasis basis;
  basis.rows.resize(gaussian.size() + 1, gaussian.num_coordinates());
  for (int k = 0; k < gaussian.size(); ++k) basis.rows.row(k + 1) = gaussian.rows.row(k).normalized();
  const auto rows = basis.rows.bottomRows(gaussian.size());
  const Eigen::VectorXf rest = gaussian.mean - rows.transpose() * (rows * gaussian.mean);
  basis.rows.row(0) = rest.normalized().transpose();
  return basis;
}

GaussianOfBasis InBasis(const FaceGaussian& gaussian, const FaceBasis& basis) {
  DAUMIER_CHECK(basis.size() == gaussian.size() + 1 && basis.rows.cols() == gaussian.num_coordinates(),
                "the basis is {} x {}, expected {} x {}", basis.rows.rows(), basis.rows.cols(), gaussian.size() + 1,
                gaussian.num_coordinates());
  return {basis.rows * gaussian.mean, gaussian.rows.rowwise().norm(), gaussian.num_symmetric};
}

FaceGaussian FromBasis(const GaussianOfBasis& gaussian, const FaceBasis& basis) {
  const Eigen::Index size = gaussian.deviation.size();
  DAUMIER_CHECK(basis.rows.rows() == size + 1 && gaussian.mean.size() == size + 1 && gaussian.num_symmetric <= size,
                "the basis has {} rows and the mean {} coordinates, expected {}", basis.rows.rows(),
                gaussian.mean.size(), size + 1);
  return {basis.rows.transpose() * gaussian.mean, gaussian.deviation.asDiagonal() * basis.rows.bottomRows(size),
          gaussian.num_symmetric};
}

std::string WriteFaceGaussian(const std::filesystem::path& file, const FaceGaussian& gaussian) {
  SafetensorsWriter writer;
  writer.SetMetadata("kind", "face gaussian");
  writer.Add<float>("mean", {gaussian.mean.size()}, {gaussian.mean.data(), size_t(gaussian.mean.size())});
  writer.Add<float>("rows", {gaussian.rows.rows(), gaussian.rows.cols()},
                    {gaussian.rows.data(), size_t(gaussian.rows.size())});
  const int num_symmetric = gaussian.num_symmetric;
  writer.Add<int32_t>("num_symmetric", {1}, {&num_symmetric, 1});
  return writer.Write(file);
}

FaceGaussian ReadFaceGaussian(const std::filesystem::path& file) {
  const SafetensorsFile arrays(file);
  const ArrayView &mean = arrays.at("mean"), &rows = arrays.at("rows"), &count = arrays.at("num_symmetric");
  DAUMIER_CHECK(mean.shape.size() == 1 && rows.shape.size() == 2 && rows.shape[1] == mean.shape[0] &&
                    mean.shape[0] % 3 == 0 && count.size() == 1,
                "{}: rows of a distribution of faces have as many coordinates as its mean", file.string());
  FaceGaussian gaussian{Eigen::Map<const Eigen::VectorXf>(mean.As<float>().data(), mean.shape[0]),
                        Eigen::Map<const Rows>(rows.As<float>().data(), rows.shape[0], rows.shape[1]),
                        count.As<int32_t>()[0]};
  DAUMIER_CHECK(gaussian.num_symmetric >= 0 && gaussian.num_symmetric <= gaussian.size(),
                "{}: {} of {} components are symmetric", file.string(), gaussian.num_symmetric, gaussian.size());
  return gaussian;
}

}  // namespace daumier::faces
