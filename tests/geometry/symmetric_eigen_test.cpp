#include "geometry/symmetric_eigen.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <limits>

namespace daumier::geometry {
namespace {

TEST(DecomposeSymmetric, TwoByTwoWorkedOutByHand) {
  Eigen::MatrixXd matrix(2, 2);
  matrix << 2, 100, 1, 2;  // The upper triangle is not read.
  const SymmetricEigen eigen = DecomposeSymmetric(matrix);
  EXPECT_TRUE(eigen.values.isApprox(Eigen::Vector2d(1, 3)));
  EXPECT_NEAR(std::abs(eigen.vectors.col(1).dot(Eigen::Vector2d(1, 1).normalized())), 1, 1e-12);
}

TEST(DecomposeSymmetric, VectorsAreOrthonormalAndGiveTheMatrixBack) {
  Eigen::MatrixXd matrix(30, 30);
  for (int i = 0; i < 30; ++i)
    for (int j = 0; j < 30; ++j) matrix(i, j) = std::sin(1 + i * j) + std::cos(i + j);
  matrix = (matrix + matrix.transpose()).eval();
  const SymmetricEigen eigen = DecomposeSymmetric(matrix);
  EXPECT_TRUE((eigen.vectors.transpose() * eigen.vectors).isIdentity(1e-12));
  EXPECT_TRUE((eigen.vectors * eigen.values.asDiagonal() * eigen.vectors.transpose()).isApprox(matrix, 1e-12));
  EXPECT_TRUE(std::is_sorted(eigen.values.begin(), eigen.values.end()));
  EXPECT_TRUE(SymmetricEigenvalues(matrix).isApprox(eigen.values, 1e-12));
}

TEST(DecomposeSymmetric, RefusesOtherShapesAndNumbersThatAreNotFinite) {
  testing::ExpectError([] { DecomposeSymmetric(Eigen::MatrixXd::Zero(2, 3)); }, "a matrix of 2 x 3 is not symmetric");
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(4, 4);
  matrix(2, 1) = std::numeric_limits<double>::quiet_NaN();
  testing::ExpectError([&] { DecomposeSymmetric(matrix); }, "do not converge");
  testing::ExpectError([&] { SymmetricEigenvalues(matrix); }, "do not converge");
}

}  // namespace
}  // namespace daumier::geometry
