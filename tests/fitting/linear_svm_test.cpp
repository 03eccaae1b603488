#include "fitting/linear_svm.h"

#include "core/random.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace daumier::testing {
namespace {

struct TwoKinds {
  Eigen::MatrixXd points;
  std::vector<bool> is_second;
};

/// N(0, I) in four dimensions; the second kind is where x_0 + x_1 > 0.3, with a few exceptions.
TwoKinds SomeTwoKinds(int count) {
  Rng rng(4);
  TwoKinds kinds{Eigen::MatrixXd(count, 4), {}};
  for (Eigen::Index i = 0; i < count; ++i) {
    for (double& number : kinds.points.row(i)) number = rng.Normal();
    kinds.is_second.push_back((kinds.points(i, 0) + kinds.points(i, 1) > 0.3) != (rng.Uniform(0, 1) < 0.05));
  }
  return kinds;
}

/// Of the points -2 and 2 the least 1/2 w^2 + 2 C (1 - 2 w)^2 has w = 8 C / (1 + 16 C); its offset is 0.
TEST(LinearSvm, OfTwoPointsIsTheRidgeSolution) {
  const Eigen::MatrixXd points = (Eigen::MatrixXd(2, 1) << -2, 2).finished();
  for (const double cost : {0.01, 0.5, 3.0}) {
    const fitting::SeparatingPlane plane = fitting::TrainLinearSvm(points, {false, true}, cost);
    EXPECT_NEAR(plane.normal[0], 8 * cost / (1 + 16 * cost), 1e-4);
    EXPECT_NEAR(plane.offset, 0, 1e-6);
    // The order of the points does not matter, that of the kinds turns the normal.
    EXPECT_NEAR(fitting::TrainLinearSvm(points, {true, false}, cost).normal[0], -plane.normal[0], 1e-6);
  }
}

/// Where the energy is least its gradient vanishes: w = 2 C sum_i s_i y_i max(0, 1 - y_i (w x_i + b)) x_i.
TEST(LinearSvm, TheGradientOfItsEnergyVanishes) {
  const TwoKinds kinds = SomeTwoKinds(300);
  const double cost = 0.1;
  const fitting::SeparatingPlane plane = fitting::TrainLinearSvm(kinds.points, kinds.is_second, cost);
  const auto num_second = double(std::ranges::count(kinds.is_second, true)), num_all = double(kinds.is_second.size());
  Eigen::VectorXd pull = Eigen::VectorXd::Zero(5);
  for (Eigen::Index i = 0; i < kinds.points.rows(); ++i) {
    const bool second = kinds.is_second[size_t(i)];
    const double side = second ? 1 : -1, share = num_all / (2 * (second ? num_second : num_all - num_second));
    const double miss = std::max(0.0, 1 - side * (kinds.points.row(i).dot(plane.normal) + plane.offset));
    pull += 2 * cost * share * side * miss * (Eigen::VectorXd(5) << kinds.points.row(i).transpose(), 1).finished();
  }
  EXPECT_LT((pull.head(4) - plane.normal).norm(), 1e-3 * plane.normal.norm());
  EXPECT_NEAR(pull[4], plane.offset, 1e-3);
}

TEST(LinearSvm, FindsThePlaneBetweenTheKinds) {
  const TwoKinds kinds = SomeTwoKinds(2000);
  const double cost = fitting::BestSvmCost(kinds.points, kinds.is_second);
  const fitting::SeparatingPlane plane = fitting::TrainLinearSvm(kinds.points, kinds.is_second, cost);
  const Eigen::VectorXd unit = plane.normal.normalized();
  EXPECT_NEAR(unit[0], std::sqrt(0.5), 0.05);
  EXPECT_NEAR(unit[1], std::sqrt(0.5), 0.05);
  // The exceptions, squared, pull it to the middle of the points.
  EXPECT_NEAR(-plane.offset / plane.normal.norm(), 0.3 * std::sqrt(0.5), 0.13);
  EXPECT_GT(fitting::BalancedAccuracy(plane, kinds.points, kinds.is_second), 0.9);
}

/// Faces come in the order of their persons, levels and expressions: each fourth is of the second kind.
TEST(LinearSvm, KindsMayComeInAnyOrder) {
  TwoKinds kinds = SomeTwoKinds(80);
  for (size_t i = 0; i < kinds.is_second.size(); ++i) {
    kinds.is_second[i] = i % 4 == 3;
    kinds.points(Eigen::Index(i), 0) = kinds.is_second[i] ? 1 : -1;
  }
  EXPECT_GT(fitting::BestSvmCost(kinds.points, kinds.is_second), 0);
}

TEST(LinearSvm, RefusesWhatItCannotSeparate) {
  const Eigen::MatrixXd points = Eigen::MatrixXd::Identity(2, 2);
  ExpectError([&] { fitting::TrainLinearSvm(points, {true, true}, 1); }, "expected both kinds");
  ExpectError([&] { fitting::TrainLinearSvm(points, {true}, 1); }, "2 points of 1 kinds");
  ExpectError([&] { fitting::TrainLinearSvm(points, {true, false}, 0); }, "cost 0");
  const Eigen::MatrixXd bad = std::numeric_limits<double>::quiet_NaN() * points;
  ExpectError([&] { fitting::TrainLinearSvm(bad, {true, false}, 1); }, "4 numbers not finite");
}

}  // namespace
}  // namespace daumier::testing
