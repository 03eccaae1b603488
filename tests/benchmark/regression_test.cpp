#include "benchmark/regression.h"

#include "core/random.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>
#include <Eigen/Dense>

namespace daumier::benchmark {
namespace {

eval::FaceRows RandomRows(int rows, int cols, uint64_t seed) {
  Rng rng(seed);
  eval::FaceRows matrix(rows, cols);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < cols; ++j) matrix(i, j) = float(rng.Normal());
  return matrix;
}

TEST(DualRegression, FindsALinearMap) {
  const eval::FaceRows x = RandomRows(30, 4, 1), map = RandomRows(4, 7, 2), queries = RandomRows(5, 4, 3);
  const Eigen::RowVectorXf shift = RandomRows(1, 7, 4);
  const DualRegression regression(x, ((x * map).rowwise() + shift).eval());
  EXPECT_LT((regression.Predict(queries, 1e-6) - ((queries * map).rowwise() + shift)).cwiseAbs().maxCoeff(), 1e-3);
}

/// A second way: the primal normal equations.
TEST(DualRegression, AgreesWithTheNormalEquations) {
  const eval::FaceRows x = RandomRows(20, 3, 1), y = RandomRows(20, 2, 2), queries = RandomRows(4, 3, 3);
  const Eigen::RowVectorXf mean_x = x.colwise().mean(), mean_y = y.colwise().mean();
  const Eigen::MatrixXf cx = x.rowwise() - mean_x, cy = y.rowwise() - mean_y;
  const float scale = cx.rowwise().squaredNorm().mean(), lambda = 0.3f;
  const Eigen::MatrixXf gram = cx.transpose() * cx + scale * lambda * Eigen::MatrixXf::Identity(3, 3);
  const Eigen::MatrixXf weights = gram.ldlt().solve(cx.transpose() * cy);
  const Eigen::MatrixXf expected = ((queries.rowwise() - mean_x) * weights).rowwise() + mean_y;
  EXPECT_LT((DualRegression(x, y).Predict(queries, lambda) - expected).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(DualRegression, OfALargeLambdaIsTheMean) {
  const eval::FaceRows x = RandomRows(20, 3, 1), y = RandomRows(20, 2, 2);
  const Eigen::RowVectorXf mean = y.colwise().mean();
  EXPECT_LT((DualRegression(x, y).Predict(x, 1e9).rowwise() - mean).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(DualRegression, SaysWhatDisagrees) {
  testing::ExpectError([] { DualRegression(RandomRows(3, 2, 1), RandomRows(4, 2, 1)); },
                       "3 rows of features, 4 of targets");
  const DualRegression regression(RandomRows(3, 2, 1), RandomRows(3, 2, 1));
  testing::ExpectError([&] { regression.Predict(RandomRows(1, 3, 1), 1); }, "3 features, expected 2");
  testing::ExpectError([&] { regression.Predict(RandomRows(1, 2, 1), 0); }, "expected > 0");
}

}  // namespace
}  // namespace daumier::benchmark
