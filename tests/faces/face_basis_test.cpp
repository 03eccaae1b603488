#include "faces/face_basis.h"

#include "core/random.h"
#include "tests/support/cancelled_task.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>
#include <Eigen/SVD>

namespace daumier::faces {
namespace {

BilinearModel::Core RandomFaces(int num_faces, int num_coordinates, int rank) {
  Rng rng(3);
  const auto draw = [&] { return static_cast<float>(rng.Normal()); };
  const Eigen::MatrixXf left = Eigen::MatrixXf::NullaryExpr(num_faces, rank, draw);
  return left * Eigen::MatrixXf::NullaryExpr(rank, num_coordinates, draw);
}

FaceBasis Fit(const BilinearModel::Core& faces, int size) {
  return FitFaceBasis(
      int(faces.rows()), int(faces.cols()),
      [&](int i) { return std::span<const float>(faces.row(i).data(), size_t(faces.cols())); }, size);
}

TEST(FaceBasis, IsTheLeadingSingularVectors) {
  const auto faces = RandomFaces(20, 45, 20);
  const FaceBasis basis = Fit(faces, 6);
  const Eigen::JacobiSVD<Eigen::MatrixXf> svd(faces, Eigen::ComputeThinV);
  for (int k = 0; k < 6; ++k) {
    EXPECT_NEAR(std::abs(basis.rows.row(k).dot(svd.matrixV().col(k))), 1, 1e-4) << k;
    Eigen::Index largest = 0;
    basis.rows.row(k).cwiseAbs().maxCoeff(&largest);
    EXPECT_GT(basis.rows(k, largest), 0);
  }
  const Eigen::MatrixXf gram = basis.rows * basis.rows.transpose();
  EXPECT_LT((gram - Eigen::MatrixXf::Identity(6, 6)).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(FaceBasis, HoldsFacesOfItsRank) {
  const auto faces = RandomFaces(20, 45, 4);
  const FaceBasis basis = Fit(faces, 4);
  const BilinearModel::Core rebuilt = (faces * basis.rows.transpose()) * basis.rows;
  EXPECT_LT((rebuilt - faces).cwiseAbs().maxCoeff(), 1e-4 * faces.cwiseAbs().maxCoeff());
}

TEST(FaceBasis, RefusesMoreDirectionsThanThereAre) {
  testing::ExpectError([] { Fit(RandomFaces(5, 45, 5), 6); }, "6 directions cannot be fitted to 5 faces");
  testing::ExpectError([] { Fit(RandomFaces(20, 45, 3), 5); }, "span fewer");
}

TEST(FaceBasis, ComesBackFromItsFileAndADamagedOneIsRefused) {
  const testing::TempDir folder;
  FaceBasis basis = Fit(RandomFaces(20, 45, 20), 3);
  basis.deviation = Eigen::VectorXf::LinSpaced(3, 1, 2);
  const auto file = folder / "basis.safetensors";
  WriteFaceBasis(file, basis);
  const FaceBasis again = ReadFaceBasis(file);
  EXPECT_EQ(again.rows, basis.rows);
  EXPECT_EQ(again.deviation, basis.deviation);
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 4);
  testing::ExpectError([&] { ReadFaceBasis(file); }, "basis.safetensors");
  basis.deviation.conservativeResize(2);
  WriteFaceBasis(file, basis);
  testing::ExpectError([&] { ReadFaceBasis(file); }, "a deviation for each of its rows");
}

TEST(FaceBasis, ACancelledTaskEndsTheFit) {
  const auto faces = RandomFaces(5, 9, 5);
  const auto face = [&](int i) { return std::span<const float>(faces.row(i).data(), 9); };
  EXPECT_THROW(FitFaceBasis(5, 9, face, 2, testing::CancelledTask()), Cancelled);
}

}  // namespace
}  // namespace daumier::faces
