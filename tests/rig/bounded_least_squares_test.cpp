#include "rig/bounded_least_squares.h"

#include "core/random.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <Eigen/QR>

#include <limits>
#include <optional>

namespace daumier::rig {
namespace {

constexpr double kNoBound = std::numeric_limits<double>::infinity();

/// A problem with its matrix.
struct BoundedProblem {
  Eigen::MatrixXd columns;
  Eigen::VectorXd wanted, most;

  Eigen::VectorXd Solved() const {
    return BoundedLeastSquares(columns.transpose() * columns, columns.transpose() * wanted, most);
  }
  double ErrorOf(const Eigen::VectorXd& x) const { return (columns * x - wanted).squaredNorm(); }
};

BoundedProblem RandomProblem(Rng& rng, int rows, int columns, double most) {
  BoundedProblem problem{Eigen::MatrixXd(rows, columns), Eigen::VectorXd(rows),
                         Eigen::VectorXd::Constant(columns, most)};
  for (double& x : problem.columns.reshaped()) x = rng.Normal();
  for (double& x : problem.wanted) x = rng.Normal();
  return problem;
}

/// The best of all choices of which variables are 0, at their bound, or free.
double LeastErrorOfAllSets(const BoundedProblem& problem) {
  const auto n = int(problem.most.size());
  double least = kNoBound;
  int num_sets = 1;
  for (int i = 0; i < n; ++i) num_sets *= 3;
  for (int set = 0; set < num_sets; ++set) {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
    std::vector<int> free;
    for (int i = 0, rest = set; i < n; ++i, rest /= 3) {
      if (rest % 3 == 1) free.push_back(i);
      if (rest % 3 == 2) x[i] = problem.most[i];
    }
    if (!x.allFinite()) continue;
    const Eigen::MatrixXd of_free = problem.columns(Eigen::all, free);
    if (!free.empty()) x(free) = of_free.colPivHouseholderQr().solve(problem.wanted - problem.columns * x).eval();
    if ((x.array() < -1e-12).any() || (x.array() > problem.most.array() + 1e-12).any()) continue;
    least = std::min(least, problem.ErrorOf(x));
  }
  return least;
}

TEST(BoundedLeastSquares, ByHand) {
  const Eigen::VectorXd apart = BoundedLeastSquares(Eigen::Matrix3d::Identity(), Eigen::Vector3d(1, -1, 3),
                                                    Eigen::Vector3d(kNoBound, kNoBound, 2));
  EXPECT_LT((apart - Eigen::Vector3d(1, 0, 2)).norm(), 1e-12);
  // Columns (1, 0) and (1, 1), wanted (0, 1): without bounds x = (-1, 1); with them the second alone, 1/2.
  const Eigen::VectorXd together = BoundedLeastSquares((Eigen::Matrix2d() << 1, 1, 1, 2).finished(),
                                                       Eigen::Vector2d(0, 1), Eigen::Vector2d(kNoBound, kNoBound));
  EXPECT_LT((together - Eigen::Vector2d(0, 0.5)).norm(), 1e-12);
}

TEST(BoundedLeastSquares, IsTheBestOfAllActiveSets) {
  Rng rng(1);
  for (int i = 0; i < 60; ++i) {
    const BoundedProblem problem = RandomProblem(rng, 7, 5, i % 3 == 0 ? kNoBound : 0.3 * (i % 3));
    const Eigen::VectorXd x = problem.Solved();
    EXPECT_GE(x.minCoeff(), 0);
    EXPECT_TRUE((x.array() <= problem.most.array()).all());
    EXPECT_NEAR(problem.ErrorOf(x), LeastErrorOfAllSets(problem), 1e-9) << i;
  }
}

TEST(BoundedLeastSquares, GradientsAreThoseOfASolution) {
  Rng rng(2);
  for (const double most : {kNoBound, 1.0}) {
    BoundedProblem problem = RandomProblem(rng, 200, 52, most);
    for (int i = 1; i < 52; ++i)
      problem.columns.col(i) += 2 * problem.columns.col(i - 1) / problem.columns.col(i - 1).norm();
    problem.columns.col(7) *= 1e-3;  // Of very different lengths.
    const Eigen::VectorXd x = problem.Solved();
    const Eigen::VectorXd gradient = problem.columns.transpose() * (problem.wanted - problem.columns * x);
    for (int i = 0; i < 52; ++i) {
      if (x[i] > 0 && x[i] < most) EXPECT_NEAR(gradient[i], 0, 1e-7) << i;
      if (x[i] == 0) EXPECT_LE(gradient[i], 1e-7) << i;
      if (x[i] == most) EXPECT_GE(gradient[i], -1e-7) << i;
    }
  }
}

TEST(BoundedLeastSquares, ZeroAndDependentColumnsStayAtTheirBounds) {
  Rng rng(3);
  BoundedProblem problem = RandomProblem(rng, 9, 4, kNoBound);
  problem.wanted = problem.columns.col(0) + 0.5 * problem.columns.col(1);
  problem.columns.col(2) = problem.columns.col(0);
  problem.columns.col(3).setZero();
  const Eigen::VectorXd x = problem.Solved();
  EXPECT_NEAR(problem.ErrorOf(x), 0, 1e-12);
  EXPECT_NEAR(x[0] + x[2], 1, 1e-9);
  EXPECT_EQ(x[3], 0);
}

TEST(BoundedLeastSquares, ColumnsThatAreNearlyZeroCountAsZero) {
  Rng rng(4);
  BoundedProblem problem = RandomProblem(rng, 9, 4, kNoBound);
  problem.columns.col(1) *= 1e-9;
  EXPECT_EQ(problem.Solved()[1], 0);
}

TEST(BoundedLeastSquares, NothingWantedIsZero) {
  EXPECT_EQ(BoundedLeastSquares(Eigen::Matrix2d::Identity(), Eigen::Vector2d::Zero(), Eigen::Vector2d::Ones()),
            Eigen::VectorXd(Eigen::Vector2d::Zero()));
}

TEST(BoundedLeastSquares, RefusesWhatIsNoProblem) {
  const Eigen::Matrix2d gram = Eigen::Matrix2d::Identity();
  const Eigen::Vector2d ones = Eigen::Vector2d::Ones();
  testing::ExpectError([&] { BoundedLeastSquares(gram, Eigen::Vector3d::Ones(), ones); }, "the right side has 3");
  testing::ExpectError([&] { BoundedLeastSquares(gram, ones * std::nan(""), ones); }, "not finite");
  testing::ExpectError([&] { BoundedLeastSquares(gram, ones, -ones); }, "negative");
}

}  // namespace
}  // namespace daumier::rig
