#include "geometry/submatrix.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::geometry {
namespace {

TEST(Submatrix, HasTheChosenRowsAndColumnsInTheirOrder) {
  const Eigen::MatrixXd dense = (Eigen::MatrixXd(3, 3) << 1, 2, 0, 4, 5, 6, 0, 8, 9).finished();
  const SparseMatrix matrix = dense.sparseView();
  const Eigen::MatrixXd expected = (Eigen::MatrixXd(2, 2) << 9, 0, 0, 1).finished();
  EXPECT_EQ(Eigen::MatrixXd(Submatrix(matrix, {1, -1, 0}, 2, {2, 0})), expected);
}

TEST(Submatrix, RefusesOtherRows) {
  const SparseMatrix matrix(3, 3);
  testing::ExpectError([&] { Submatrix(matrix, {0, 1}, 2, {0}); }, "2 places for 3 rows");
}

}  // namespace
}  // namespace daumier::geometry
