#include "rig/weight_solver.h"

#include "rig/arkit_names.h"
#include "tests/rig/random_targets.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace daumier::rig {
namespace {

using testing::ExpectError;
using testing::RandomTargets;
using testing::RandomWeights;

constexpr int kNumPoints = 60;
const Eigen::VectorXd kNoBounds = Eigen::VectorXd::Constant(kNumArkitNames, std::numeric_limits<double>::infinity());

Eigen::Index WeightAt(const char* name) {
  return *FindArkitName(name);
}

TEST(WeightSolver, RecoversWeights) {
  Rng rng(1);
  const MorphTargets targets = RandomTargets(kNumPoints, rng);
  const WeightSolver solver(targets, Eigen::VectorXd::Ones(kNumPoints), kNoBounds);
  for (int i = 0; i < 5; ++i) {
    const Eigen::VectorXd weights = RandomWeights(rng);
    const Eigen::VectorXd displacement = targets.offsets.cast<double>() * weights;
    EXPECT_LT((solver.Solve(displacement) - weights).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LT((solver.Displacement(weights) - displacement).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(WeightSolver, VerticesWithoutMassDoNotCount) {
  Rng rng(2);
  const MorphTargets targets = RandomTargets(kNumPoints, rng);
  Eigen::VectorXd masses = Eigen::VectorXd::Ones(kNumPoints);
  masses.tail(10).setZero();
  const WeightSolver solver(targets, masses, kNoBounds);
  EXPECT_EQ(solver.vertices().size(), size_t(kNumPoints - 10));
  const Eigen::VectorXd weights = RandomWeights(rng);
  Eigen::VectorXd displacement = targets.offsets.cast<double>() * weights;
  displacement.tail(30).setConstant(7);
  EXPECT_LT((solver.Solve(displacement) - weights).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_NEAR(solver.ErrorOf(displacement, weights).greatest_cm, 0, 1e-9);
}

TEST(WeightSolver, KeepsBoundsAndAMouthBelowItsJaw) {
  Rng rng(3);
  const MorphTargets targets = RandomTargets(kNumPoints, rng);
  Eigen::VectorXd most = Eigen::VectorXd::Ones(kNumArkitNames);
  most[WeightAt("eyeLookUpLeft")] = 0;
  const WeightSolver solver(targets, Eigen::VectorXd::Ones(kNumPoints), most);
  Eigen::VectorXd wanted = Eigen::VectorXd::Zero(kNumArkitNames);
  wanted[WeightAt("mouthClose")] = 0.8;
  wanted[WeightAt("jawOpen")] = 0.2;
  wanted[WeightAt("browInnerUp")] = 2;
  wanted[WeightAt("eyeLookUpLeft")] = 0.5;
  const Eigen::VectorXd weights = solver.Solve(targets.offsets.cast<double>() * wanted);
  EXPECT_LE(weights[WeightAt("mouthClose")], weights[WeightAt("jawOpen")]);
  EXPECT_GT(weights[WeightAt("mouthClose")], 0.2) << "both rise";
  EXPECT_LE(weights.maxCoeff(), 1);
  EXPECT_EQ(weights[WeightAt("browInnerUp")], 1);
  EXPECT_EQ(weights[WeightAt("eyeLookUpLeft")], 0);
}

TEST(WeightSolver, ErrorsByHand) {
  MorphTargets targets{{ArkitNames().begin(), ArkitNames().end()}, Eigen::MatrixXf::Zero(6, kNumArkitNames)};
  targets.offsets(0, 3) = 2;  // Vertex 0 along x.
  const WeightSolver solver(targets, Eigen::Vector2d(3, 1), kNoBounds);
  Eigen::VectorXd displacement = Eigen::VectorXd::Zero(6);
  displacement << 1, 0, 0, 0, 3, 4;
  const Eigen::VectorXd weights = solver.Solve(displacement);
  EXPECT_NEAR(weights[3], 0.5, 1e-12);
  const DisplacementError error = solver.ErrorOf(displacement, weights);
  EXPECT_NEAR(error.rms_cm, std::sqrt(25.0 / 4), 1e-12);
  EXPECT_NEAR(error.greatest_cm, 5, 1e-12);
  EXPECT_NEAR(solver.ErrorOf(displacement, Eigen::VectorXd::Zero(kNumArkitNames)).rms_cm, std::sqrt(28.0 / 4), 1e-12);
}

TEST(WeightSolver, SeparatesMotionsWithoutBounds) {
  Rng rng(4);
  const MorphTargets targets = RandomTargets(kNumPoints, rng);
  const WeightSolver solver(targets, Eigen::VectorXd::Constant(kNumPoints, 0.5), kNoBounds);
  Eigen::MatrixXd motions(3 * kNumPoints, 2);
  for (double& x : motions.reshaped()) x = rng.Normal();
  const Eigen::VectorXd weights = RandomWeights(rng);
  const Eigen::Vector2d of_motions(-3, 0.25);
  const auto solved = solver.Solve(targets.offsets.cast<double>() * weights + motions * of_motions, motions);
  EXPECT_LT((solved.weights - weights).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((solved.motions - of_motions).norm(), 1e-9);
}

TEST(WeightSolver, BoundsByName) {
  const Eigen::VectorXd without = MostWeights(1, GazeTargets::kZero), with = MostWeights(2, GazeTargets::kUsed);
  EXPECT_EQ(without.sum(), 52 - 8 - 1);
  EXPECT_EQ(without[WeightAt("eyeLookDownRight")], 0);
  EXPECT_EQ(with.sum(), 2 * (52 - 1));
  EXPECT_EQ(with[WeightAt("tongueOut")], 0);
}

TEST(WeightSolver, RefusesWhatDoesNotFit) {
  Rng rng(5);
  MorphTargets targets = RandomTargets(4, rng);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(4);
  ExpectError([&] { WeightSolver(targets, Eigen::VectorXd::Ones(5), kNoBounds); }, "do not fit");
  ExpectError([&] { WeightSolver(targets, 0 * ones, kNoBounds); }, "no vertex of the face has an area");
  const WeightSolver solver(targets, ones, kNoBounds);
  ExpectError([&] { solver.Solve(Eigen::VectorXd::Zero(9)); }, "has 9 coordinates, expected 12");
  ExpectError([&] { solver.Solve(Eigen::VectorXd::Constant(12, std::nan(""))); }, "not finite");
  std::swap(targets.names[0], targets.names[1]);
  ExpectError([&] { WeightSolver(targets, ones, kNoBounds); }, "not the 52 of ARKit");
}

}  // namespace
}  // namespace daumier::rig
