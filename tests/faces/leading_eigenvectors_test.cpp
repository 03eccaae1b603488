#include "faces/leading_eigenvectors.h"

#include "core/random.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>
#include <Eigen/QR>

namespace daumier::faces {
namespace {

TEST(FindLeadingEigenvectors, AreThoseByHand) {
  Eigen::MatrixXd matrix(2, 2);
  matrix << 2, 99, 1, 2;  // The upper triangle is not read: eigenvalues 3 and 1, along (1, 1) and (1, -1).
  const LeadingEigenvectors first = FindLeadingEigenvectors(matrix, 1);
  EXPECT_NEAR(first.values[0], 3, 1e-14);
  EXPECT_NEAR(std::abs(first.vectors.col(0).dot(Eigen::Vector2d(1, 1).normalized())), 1, 1e-14);
  EXPECT_NEAR(FindLeadingEigenvectors(matrix, 2).values[1], 1, 1e-14);
}

/// Q diag(values) Q^T, with `orthonormal` the columns of Q.
Eigen::MatrixXd Symmetric(const Eigen::MatrixXd& orthonormal, const Eigen::VectorXd& values) {
  return orthonormal * values.asDiagonal() * orthonormal.transpose();
}

TEST(FindLeadingEigenvectors, OfALargeMatrixAreTheOnesThatItWasMadeOf) {
  constexpr int kSize = 2000, kCount = 4, kRank = 8;
  Rng rng(5);
  const Eigen::MatrixXd noise = Eigen::MatrixXd::NullaryExpr(kSize, kRank, [&] { return rng.Normal(); });
  const Eigen::MatrixXd made =
      Eigen::HouseholderQR<Eigen::MatrixXd>(noise).householderQ() * Eigen::MatrixXd::Identity(kSize, kRank);
  const Eigen::VectorXd values = (Eigen::VectorXd(kRank) << 900, 30, 29, 5, 4.9, 1, 0.1, -2000).finished();
  const LeadingEigenvectors found = FindLeadingEigenvectors(Symmetric(made, values), kCount);
  ASSERT_EQ(found.vectors.cols(), kCount);
  for (int k = 0; k < kCount; ++k) {
    EXPECT_NEAR(found.values[k], values[k], 1e-8);
    EXPECT_NEAR(std::abs(found.vectors.col(k).dot(made.col(k))), 1, 1e-9) << k;
  }
}

TEST(FindLeadingEigenvectors, RefusesACountThatIsNotThere) {
  testing::ExpectError([] { FindLeadingEigenvectors(Eigen::MatrixXd::Identity(3, 3), 4); },
                       "4 eigenvectors of a matrix of 3 x 3");
  testing::ExpectError([] { FindLeadingEigenvectors(Eigen::MatrixXd::Identity(3, 3), 0); }, "0 eigenvectors");
}

}  // namespace
}  // namespace daumier::faces
