#include "fitting/gauss_newton.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace daumier::testing {
namespace {

TEST(GaussNewton, SolvesALinearProblemInOneStep) {
  Eigen::Matrix<double, 3, 2> a;
  a << 1, 2, 3, 4, 5, 7;
  const Eigen::Vector3d b(1, -1, 2);
  int num_derivatives = 0;
  const fitting::SquaredEnergy residuals{
      .residuals = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return a * x - b; },
      .derivative = [&](const Eigen::VectorXd&) -> Eigen::MatrixXd {
        ++num_derivatives;
        return a;
      },
      .prior_weights = Eigen::Vector2d::Zero(),
      .prior_mean = Eigen::Vector2d::Zero(),
      .is_linear = true};
  const fitting::Minimum minimum = fitting::Minimise(residuals, Eigen::Vector2d::Zero(), 20);
  const Eigen::Vector2d exact = (a.transpose() * a).inverse() * a.transpose() * b;
  EXPECT_LT((minimum.x - exact).norm(), 1e-6);
  EXPECT_EQ(num_derivatives, 1);
}

/// Rosenbrock's function: a curved valley whose minimum is at (1, 1).
TEST(GaussNewton, EnergiesOfACurvedValleyNeverRise) {
  const fitting::SquaredEnergy residuals{.residuals = [](const Eigen::VectorXd& x) -> Eigen::VectorXd {
                                           return Eigen::Vector2d(10 * (x[1] - x[0] * x[0]), 1 - x[0]);
                                         },
                                         .derivative = [](const Eigen::VectorXd& x) -> Eigen::MatrixXd {
                                           return Eigen::Matrix2d{{-20 * x[0], 10}, {-1, 0}};
                                         },
                                         .prior_weights = Eigen::Vector2d::Zero(),
                                         .prior_mean = Eigen::Vector2d::Zero()};
  const fitting::Minimum minimum = fitting::Minimise(residuals, Eigen::Vector2d(-1.2, 1), 200);
  EXPECT_LT((minimum.x - Eigen::Vector2d(1, 1)).norm(), 1e-3);
  for (size_t i = 1; i < minimum.energies.size(); ++i) EXPECT_LT(minimum.energies[i], minimum.energies[i - 1]);
}

TEST(GaussNewton, ThePriorPullsToItsMean) {
  const Eigen::Vector2d target(4, 0), mean(0, 2), weights(3, 1);
  const fitting::SquaredEnergy energy{
      .residuals = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return x - target; },
      .derivative = [](const Eigen::VectorXd&) -> Eigen::MatrixXd { return Eigen::Matrix2d::Identity(); },
      .prior_weights = weights,
      .prior_mean = mean,
      .is_linear = true};
  const fitting::Minimum minimum = fitting::Minimise(energy, Eigen::Vector2d::Zero(), 5);
  EXPECT_LT((minimum.x - Eigen::Vector2d(1, 1)).norm(), 1e-6);  // 4 / (1 + 3), 2 / (1 + 1).
  EXPECT_NEAR(minimum.energies.back(), 9 + 1 + 3 + 1, 1e-6);
}

TEST(GaussNewton, RefusesAStartThatIsNotFinite) {
  const fitting::SquaredEnergy residuals{
      .residuals = [](const Eigen::VectorXd& x) -> Eigen::VectorXd {
        return x * std::numeric_limits<double>::quiet_NaN();
      },
      .derivative = [](const Eigen::VectorXd&) -> Eigen::MatrixXd { return Eigen::Matrix2d::Identity(); },
      .prior_weights = Eigen::Vector2d::Zero(),
      .prior_mean = Eigen::Vector2d::Zero()};
  ExpectError([&] { fitting::Minimise(residuals, Eigen::Vector2d::Ones(), 3); }, "not finite");
}

}  // namespace
}  // namespace daumier::testing
