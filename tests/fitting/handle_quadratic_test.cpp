#include "fitting/handle_quadratic.h"

#include "core/random.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>
#include <Eigen/Cholesky>

namespace daumier::testing {
namespace {

using fitting::HandleQuadratic;

Eigen::MatrixXd RandomMatrix(int rows, int columns, uint64_t seed) {
  Rng rng(seed);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return rng.Normal(); });
}

/// The normal equations, all at once.
Eigen::VectorXd Plain(const Eigen::MatrixXd& h, const Eigen::MatrixXd& o, const Eigen::VectorXd& handle_moves,
                      const Eigen::VectorXd& outside_moves, const HandleQuadratic::Deviations& deviations) {
  const double by_h = 1 / (deviations.handle * deviations.handle), by_o = 1 / (deviations.outside * deviations.outside);
  const Eigen::MatrixXd normal =
      Eigen::MatrixXd::Identity(h.cols(), h.cols()) + by_h * h.transpose() * h + by_o * o.transpose() * o;
  return normal.llt().solve(by_h * h.transpose() * handle_moves + by_o * o.transpose() * outside_moves);
}

TEST(HandleQuadratic, IsTheSolutionOfTheNormalEquations) {
  const Eigen::MatrixXd h = RandomMatrix(6, 20, 1), o = RandomMatrix(45, 20, 2);
  const Eigen::VectorXd handle_moves = RandomMatrix(6, 1, 3), outside_moves = RandomMatrix(45, 1, 4);
  const HandleQuadratic quadratic(h, o);
  for (const HandleQuadratic::Deviations deviations :
       {HandleQuadratic::Deviations{1, 1}, HandleQuadratic::Deviations{0.01, 3},
        HandleQuadratic::Deviations{0.02, 0.003}}) {
    const Eigen::VectorXd plain = Plain(h, o, handle_moves, outside_moves, deviations);
    EXPECT_LT((quadratic.Minimum(handle_moves, outside_moves, deviations) - plain).norm(), 1e-6 * plain.norm());
    const Eigen::VectorXd still = Plain(h, o, handle_moves, Eigen::VectorXd::Zero(45), deviations);
    EXPECT_LT((quadratic.Minimum(handle_moves, {}, deviations) - still).norm(), 1e-6 * still.norm());
  }
}

TEST(HandleQuadratic, HandlesAloneNeedNoOutside) {
  const Eigen::MatrixXd h = RandomMatrix(3, 20, 5);
  const Eigen::VectorXd handle_moves = RandomMatrix(3, 1, 6);
  const Eigen::VectorXd plain =
      Plain(h, Eigen::MatrixXd::Zero(1, 20), handle_moves, Eigen::VectorXd::Zero(1), {0.1, 1});
  EXPECT_LT((HandleQuadratic(h, Eigen::MatrixXd()).Minimum(handle_moves, {}, {0.1, 1}) - plain).norm(), 1e-9);
}

TEST(HandleQuadratic, RefusesOtherSizes) {
  const Eigen::MatrixXd h = RandomMatrix(3, 20, 7);
  ExpectError([&] { HandleQuadratic(h, RandomMatrix(6, 19, 8)); }, "20 numbers, the outside 19");
  const HandleQuadratic quadratic(h, RandomMatrix(6, 20, 9));
  ExpectError([&] { quadratic.Minimum(Eigen::VectorXd::Zero(4), {}, {1, 1}); }, "4 moves of handles, expected 3");
  ExpectError(
      [&] {
        quadratic.Minimum(Eigen::VectorXd::Zero(3), Eigen::VectorXd::Zero(5), {1, 1});
      },
      "5 moves of the outside, expected 6");
}

}  // namespace
}  // namespace daumier::testing
