#include "rig/blend.h"

#include "core/random.h"
#include "tests/support/expect_error.h"
#include "tests/support/from_threads.h"

#include <gtest/gtest.h>

namespace daumier::rig {
namespace {

/// Targets that move random runs of vertices; every fourth moves all, and the last none.
struct RandomRig {
  geometry::Points rest;
  MorphTargets targets;

  RandomRig(int num_vertices, int num_targets) : rest(num_vertices, 3) {
    Rng rng(7);
    for (double& coordinate : rest.reshaped()) coordinate = rng.Uniform(-10, 10);
    targets.offsets = Eigen::MatrixXf::Zero(3 * num_vertices, num_targets);
    for (int t = 0; t < num_targets; ++t) {
      targets.names.push_back("target" + std::to_string(t));
      if (t + 1 == num_targets) continue;
      const bool is_whole = t % 4 == 0;
      const int begin = is_whole ? 0 : static_cast<int>(rng.Below(uint64_t(num_vertices)));
      const int end = is_whole ? num_vertices : std::min(num_vertices, begin + num_vertices / 5 + 1);
      for (int i = 3 * begin; i < 3 * end; ++i) targets.offsets(i, t) = float(rng.Uniform(-2, 2));
    }
  }
};

/// The same sum as a dense product in double precision.
geometry::Points DenseSum(const RandomRig& rig, const std::vector<float>& weights) {
  const Eigen::VectorXd sum =
      rig.targets.offsets.cast<double>() *
      Eigen::Map<const Eigen::VectorXf>(weights.data(), Eigen::Index(weights.size())).cast<double>();
  return rig.rest + Eigen::Map<const geometry::Points>(sum.data(), rig.rest.rows(), 3);
}

TEST(Blend, TwoTargetsOfTwoVerticesByHand) {
  geometry::Points rest(2, 3);
  rest << 1, 2, 3, 4, 5, 6;
  MorphTargets targets{{"a", "b"}, Eigen::MatrixXf::Zero(6, 2)};
  targets.offsets(0, 0) = 1;
  targets.offsets(5, 1) = -2;
  geometry::Points expected = rest;
  expected(0, 0) += 0.5;
  expected(1, 2) -= 2 * 0.25;
  EXPECT_EQ(Blend(rest, targets).At(std::vector<float>{0.5f, 0.25f}), expected);
  EXPECT_EQ(Blend(rest, targets).At(std::vector<float>{0, 0}), rest);
}

TEST(Blend, IsTheDenseProductWhateverTheSizes) {
  for (const int num_vertices : {1, 5, 6, 16, 1365, 1366, 4001}) {
    const RandomRig rig(num_vertices, 9);
    const Blend blend(rig.rest, rig.targets);
    Rng rng(3);
    std::vector<float> weights(9);
    for (float& weight : weights) weight = float(rng.Uniform(-1, 2));
    weights[2] = 0;
    EXPECT_NEAR((blend.At(weights) - DenseSum(rig, weights)).cwiseAbs().maxCoeff(), 0, 2e-5) << num_vertices;
  }
}

TEST(Blend, StoresOnlyBlocksThatMove) {
  RandomRig rig(1600, 3);
  rig.targets.offsets.setZero();
  rig.targets.offsets(100, 1) = 1;
  const Blend blend(rig.rest, rig.targets);
  EXPECT_EQ(blend.num_bytes(), sizeof(BlendBlock));
  EXPECT_EQ(blend.num_targets(), 3);
  EXPECT_EQ(blend.num_vertices(), 1600);
}

TEST(Blend, LeavesOutMovesOfAtMostTheTolerance) {
  RandomRig rig(1600, 2);
  rig.targets.offsets.setConstant(1e-4f);
  rig.targets.offsets(0, 1) = 1;
  const Blend blend(rig.rest, rig.targets, 1e-4f);
  EXPECT_EQ(blend.num_bytes(), sizeof(BlendBlock));
  EXPECT_NEAR((blend.At(std::vector<float>{1, 1}) - DenseSum(rig, {1, 1})).cwiseAbs().maxCoeff(), 0, 2.1e-4);
}

TEST(Blend, WritesNothingBehindThePositions) {
  const RandomRig rig(7, 3);
  std::vector<float> positions(24, 99.0f);
  Blend(rig.rest, rig.targets).Apply(std::vector<float>{1, 1, 1}, std::span(positions).first(21));
  EXPECT_NE(positions[20], 99.0f);
  for (size_t i = 21; i < 24; ++i) EXPECT_EQ(positions[i], 99.0f);
}

TEST(Blend, IsSharedByThreads) {
  const RandomRig rig(2000, 8);
  const Blend blend(rig.rest, rig.targets);
  testing::ExpectTheSameFromThreads(20, [&] { return blend.At(std::vector<float>(8, 0.3f)); });
}

TEST(Blend, RefusesSizesThatDoNotFit) {
  const RandomRig rig(7, 3);
  const Blend blend(rig.rest, rig.targets);
  std::vector<float> positions(21);
  testing::ExpectError([&] { blend.Apply(std::vector<float>{1, 1}, positions); }, "2 weights for 3 targets");
  testing::ExpectError(
      [&] {
        blend.Apply(std::vector<float>{1, 1, 1}, std::span(positions).first(20));
      },
      "20 coordinates, expected 21");
  testing::ExpectError([&] { Blend(rig.rest.topRows(6), rig.targets); }, "21 rows, expected 18");
  MorphTargets unnamed = rig.targets;
  unnamed.names.pop_back();
  testing::ExpectError([&] { Blend(rig.rest, unnamed); }, "2 names");
}

}  // namespace
}  // namespace daumier::rig
