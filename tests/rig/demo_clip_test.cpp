#include "rig/demo_clip.h"

#include "rig/arkit_names.h"

#include <gtest/gtest.h>

#include <set>

namespace daumier::rig {
namespace {

WeightsClip ArkitDemo() {
  std::vector<std::string> names;
  for (const std::string_view name : ArkitNames()) names.emplace_back(name);
  return DemoClip(names);
}

TEST(DemoClip, StaysWithinZeroAndOneAndIsNeutralAtBothEnds) {
  const WeightsClip clip = ArkitDemo();
  EXPECT_EQ(clip.num_frames(), 301);
  EXPECT_EQ(clip.names.size(), 52u);
  EXPECT_GE(clip.weights.minCoeff(), 0);
  EXPECT_LE(clip.weights.maxCoeff(), 1);
  for (const int first : {0, clip.num_frames() - 7}) {
    EXPECT_TRUE(clip.weights.middleRows(first, 7).isZero());
    EXPECT_TRUE(clip.head.middleRows(first, 7).isZero(1e-6f));
  }
}

TEST(DemoClip, ShowsBlinkJawSmileGazeAndNodWithoutJumps) {
  const WeightsClip clip = ArkitDemo();
  std::set<std::string> moved;
  for (Eigen::Index t = 0; t < clip.weights.cols(); ++t) {
    if (!clip.weights.col(t).isZero()) moved.insert(clip.names[size_t(t)]);
  }
  for (const char* name : {"eyeBlinkLeft", "eyeBlinkRight", "jawOpen", "mouthSmileLeft", "eyeLookOutLeft",
                           "eyeLookInLeft", "eyeLookUpRight", "eyeLookDownRight", "browInnerUp"}) {
    EXPECT_TRUE(moved.contains(name)) << name;
  }
  EXPECT_EQ(moved.size(), 18u) << "a name of the clip is misspelt";
  EXPECT_GT(clip.head.maxCoeff(), 0.1f);
  const int last = clip.num_frames() - 1;
  EXPECT_LT((clip.weights.bottomRows(last) - clip.weights.topRows(last)).cwiseAbs().maxCoeff(), 0.25f);
}

TEST(DemoClip, MovesOnlyTargetsThatThereAre) {
  const WeightsClip clip = DemoClip({"jawOpen", "unheardOf"});
  EXPECT_EQ(clip.weights.cols(), 2);
  EXPECT_GT(clip.weights.col(0).maxCoeff(), 0.5f);
  EXPECT_TRUE(clip.weights.col(1).isZero());
}

}  // namespace
}  // namespace daumier::rig
