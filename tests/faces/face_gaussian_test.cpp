#include "faces/face_gaussian.h"

#include "core/random.h"
#include "tests/support/cancelled_task.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>
#include <Eigen/Dense>

namespace daumier::faces {
namespace {

/// Vertices 0 and 1 are each other's images, 2 its own.
const std::vector<int> kMirror = {1, 0, 2};

FaceGaussian FitGaussian(const BilinearModel::Core& faces, const std::vector<int>& mirror,
                         FaceGaussianOptions options) {
  return FitFaceGaussian(
      int(faces.rows()), int(faces.cols()),
      [&](int i) { return std::span<const float>(faces.row(i).data(), size_t(faces.cols())); }, mirror, options);
}

BilinearModel::Core NormalFaces(int num_faces, int num_coordinates) {
  Rng rng(11);
  return BilinearModel::Core::NullaryExpr(num_faces, num_coordinates, [&] { return float(rng.Normal()); });
}

TEST(FaceGaussian, RowsAreStandardDeviationsAlongTheAxesOfTheCovariance) {
  const BilinearModel::Core faces = NormalFaces(200, 9);
  const FaceGaussian gaussian = FitGaussian(faces, {}, {9, 0});
  const BilinearModel::Core centred = faces.rowwise() - faces.colwise().mean();
  EXPECT_TRUE(gaussian.mean.isApprox(faces.colwise().mean().transpose(), 1e-5));
  EXPECT_TRUE((gaussian.rows.transpose() * gaussian.rows).isApprox(centred.transpose() * centred / 200, 1e-4));
}

TEST(FaceGaussian, HasTheMirrorImagesOfItsFaces) {
  const BilinearModel::Core faces = NormalFaces(50, 9);
  const FaceGaussian gaussian = FitGaussian(faces, kMirror, {9, 9});
  EXPECT_EQ(gaussian.num_symmetric, 5) << "two vertices share three coordinates, the third has two";
  EXPECT_EQ(gaussian.size(), 9);
  BilinearModel::Core both(100, 9);
  Eigen::Matrix<float, 9, 9> mirror = Eigen::Matrix<float, 9, 9>::Zero();
  for (int v = 0; v < 3; ++v) mirror.block<3, 3>(3 * v, 3 * kMirror[size_t(v)]).diagonal() << -1, 1, 1;
  both << faces, faces * mirror.transpose();
  const BilinearModel::Core centred = both.rowwise() - both.colwise().mean();
  EXPECT_TRUE((gaussian.rows.transpose() * gaussian.rows).isApprox(centred.transpose() * centred / 100, 1e-4));
  for (int k = 0; k < 9; ++k) {
    const Eigen::RowVectorXf image = gaussian.rows.row(k) * mirror.transpose();
    EXPECT_TRUE(image.isApprox((k < 5 ? 1 : -1) * gaussian.rows.row(k), 1e-4)) << k;
  }
}

TEST(FaceGaussian, FindsTheCoefficientsOfItsFaces) {
  const FaceGaussian gaussian = FitGaussian(NormalFaces(50, 9), kMirror, {3, 2});
  const Eigen::VectorXf coefficients = Eigen::VectorXf::LinSpaced(gaussian.size(), -1, 2);
  const Eigen::VectorXf face = Reconstruct(gaussian, coefficients);
  EXPECT_TRUE(CoefficientsOf(gaussian, {face.data(), size_t(face.size())}).isApprox(coefficients, 1e-4));
  EXPECT_TRUE(CoefficientsOf(gaussian, {gaussian.mean.data(), 9}).isZero());
}

TEST(FaceGaussian, OfOneFaceIsThatFace) {
  const BilinearModel::Core faces = NormalFaces(1, 9);
  const FaceGaussian gaussian = FitGaussian(faces, {}, {4, 4});
  EXPECT_EQ(gaussian.size(), 0);
  EXPECT_TRUE(Reconstruct(gaussian, {}).isApprox(faces.row(0).transpose()));
}

TEST(FaceGaussian, ComesBackFromItsFileAndADamagedOneIsRefused) {
  const testing::TempDir folder;
  FaceGaussian gaussian = FitGaussian(NormalFaces(20, 9), kMirror, {3, 2});
  const auto file = folder / "gaussian.safetensors";
  WriteFaceGaussian(file, gaussian);
  const FaceGaussian again = ReadFaceGaussian(file);
  EXPECT_EQ(again.mean, gaussian.mean);
  EXPECT_EQ(again.rows, gaussian.rows);
  EXPECT_EQ(again.num_symmetric, 3);
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 4);
  testing::ExpectError([&] { ReadFaceGaussian(file); }, "gaussian.safetensors");
  gaussian.num_symmetric = 6;
  WriteFaceGaussian(file, gaussian);
  testing::ExpectError([&] { ReadFaceGaussian(file); }, "6 of 5 components");
  gaussian.mean.conservativeResize(6);
  WriteFaceGaussian(file, gaussian);
  testing::ExpectError([&] { ReadFaceGaussian(file); }, "as many coordinates as its mean");
}

TEST(GaussianBasis, IsOrthonormalAndHoldsTheWholeGaussian) {
  const FaceGaussian gaussian = FitGaussian(NormalFaces(20, 9), kMirror, {3, 2});
  const FaceBasis basis = BasisOf(gaussian);
  ASSERT_EQ(basis.size(), gaussian.size() + 1);
  const Eigen::MatrixXf products = basis.rows * basis.rows.transpose();
  EXPECT_LT((products - Eigen::MatrixXf::Identity(basis.size(), basis.size())).cwiseAbs().maxCoeff(), 1e-5);
  const FaceGaussian again = FromBasis(InBasis(gaussian, basis), basis);
  EXPECT_LT((again.mean - gaussian.mean).cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_LT((again.rows - gaussian.rows).cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_EQ(again.num_symmetric, gaussian.num_symmetric);
  FaceBasis smaller = basis;
  smaller.rows = basis.rows.topRows(2);
  testing::ExpectError([&] { InBasis(gaussian, smaller); }, "the basis is 2 x 9");
  testing::ExpectError([&] { FromBasis(InBasis(gaussian, basis), smaller); }, "the basis has 2 rows");
}

TEST(FaceGaussian, RefusesWhatDoesNotFit) {
  const auto faces = NormalFaces(2, 9);
  testing::ExpectError([&] { FitGaussian(faces, {1, 0}, {}); }, "a mirror map of 2 vertices");
  testing::ExpectError([&] { FitGaussian(BilinearModel::Core(0, 9), {}, {}); }, "needs faces");
  const FaceGaussian gaussian = FitGaussian(faces, {}, {1, 0});
  testing::ExpectError([&] { Reconstruct(gaussian, Eigen::VectorXf::Zero(3)); }, "3 coefficients for 1");
  const auto face = [&](int i) { return std::span<const float>(faces.row(i).data(), 9); };
  EXPECT_THROW(FitFaceGaussian(2, 9, face, {}, {}, testing::CancelledTask()), Cancelled);
}

}  // namespace
}  // namespace daumier::faces
