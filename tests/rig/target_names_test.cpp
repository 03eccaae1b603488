#include "rig/target_names.h"

#include "rig/arkit_names.h"
#include "rig/gaze.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace daumier::rig {
namespace {

using ::testing::ElementsAre;

/// Each target's only number is its place.
MorphTargets NumberedTargets(const std::vector<std::string>& names) {
  MorphTargets targets{names, Eigen::MatrixXf(1, Eigen::Index(names.size()))};
  for (size_t t = 0; t < names.size(); ++t) targets.offsets(0, Eigen::Index(t)) = float(t + 1);
  return targets;
}

TEST(InPreset, SpellsAndSortsTargetsWithTheirOffsets) {
  const MorphTargets targets = NumberedTargets({"viseme_sil", "tongueOut", "jawOpen", "eyeBlinkLeft", "browDownLeft"});
  const MorphTargets unreal = InPreset(targets, NamePreset::kUnreal);
  EXPECT_THAT(unreal.names, ElementsAre("EyeBlinkLeft", "JawOpen", "BrowDownLeft", "TongueOut", "viseme_sil"));
  EXPECT_EQ(unreal.offsets, (Eigen::RowVectorXf(5) << 4, 3, 5, 2, 1).finished());
  EXPECT_THAT(InPreset(targets, NamePreset::kArkitSides).names,
              ElementsAre("eyeBlink_L", "jawOpen", "browDown_L", "tongueOut", "viseme_sil"));
  const MorphTargets mediapipe = InPreset(targets, NamePreset::kMediaPipe);
  EXPECT_THAT(mediapipe.names,
              ElementsAre("_neutral", "browDownLeft", "eyeBlinkLeft", "jawOpen", "tongueOut", "viseme_sil"));
  EXPECT_EQ(mediapipe.offsets, (Eigen::RowVectorXf(6) << 0, 5, 4, 3, 2, 1).finished());
}

/// The index of a category is that of its target.
TEST(InPreset, OfMediaPipeHasItsIndices) {
  const MorphTargets all =
      InPreset(NumberedTargets({ArkitNames().begin(), ArkitNames().end()}), NamePreset::kMediaPipe);
  ASSERT_EQ(all.num_targets(), 53);
  EXPECT_EQ(all.names[9], "eyeBlinkLeft");
  EXPECT_EQ(all.names[25], "jawOpen");
  EXPECT_EQ(all.names[51], "noseSneerRight");
  EXPECT_EQ(all.names[52], "tongueOut");
}

TEST(InPreset, OfTargetsIsUndoneByArkits) {
  const MorphTargets all = NumberedTargets({ArkitNames().begin(), ArkitNames().end()});
  for (const auto& [word, preset] : kNamePresets) {
    if (preset == NamePreset::kMediaPipe) continue;
    const MorphTargets again = InPreset(InPreset(all, preset), NamePreset::kArkit);
    EXPECT_EQ(again.names, all.names) << word;
    EXPECT_EQ(again.offsets, all.offsets) << word;
  }
}

TEST(InPreset, OfAClipKeepsTheTurnsOfItsEyes) {
  WeightsClip clip;
  clip.names = {"eyeLookOutLeft", "viseme_sil"};
  clip.weights = Eigen::MatrixXf::Ones(1, 2);
  const WeightsClip unreal = InPreset(clip, NamePreset::kUnreal);
  EXPECT_THAT(unreal.names, ElementsAre("EyeLookOutLeft", "viseme_sil"));
  EXPECT_EQ(unreal.weights, clip.weights);
  EXPECT_TRUE(EyeTurns(unreal, EyeSide::kLeft).isApprox(EyeTurns(clip, EyeSide::kLeft)));
  EXPECT_FALSE(EyeTurns(unreal, EyeSide::kLeft).isZero());
}

}  // namespace
}  // namespace daumier::rig
