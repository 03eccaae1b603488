#include "rig/weight_limits.h"

#include "rig/arkit_names.h"
#include "rig/face_contact.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace daumier::rig {
namespace {

WeightsClip ClipOf(std::vector<std::string> names, std::initializer_list<float> weights) {
  WeightsClip clip;
  clip.names = std::move(names);
  clip.weights = Eigen::MatrixXf::Zero(1, Eigen::Index(weights.size()));
  std::ranges::copy(weights, clip.weights.data());
  return clip;
}

TEST(WeightLimits, OfBlinksAreTheBlinkLimit) {
  WeightsClip clip = ClipOf({"eyeBlinkLeft", "eyeSquintLeft", "eyeLookDownLeft", "eyeBlinkRight"}, {1, 0.4f, 0.6f, 1});
  LimitWeights(clip);
  EXPECT_NEAR(clip.weights(0, 0), BlinkLimit(0.4, 0.6), 1e-6);
  EXPECT_EQ(clip.weights(0, 3), 1) << "of the other side";
  EXPECT_EQ(clip.weights(0, 1), 0.4f);
}

TEST(WeightLimits, AMouthClosesNoFartherThanItsJawOpens) {
  WeightsClip clip = ClipOf({"JawOpen", "MouthClose"}, {0.25f, 0.5f});
  LimitWeights(clip);
  EXPECT_EQ(clip.weights(0, 1), 0.25f);
  WeightsClip alone = ClipOf({"mouthClose"}, {0.5f});
  LimitWeights(alone);
  EXPECT_EQ(alone.weights(0, 0), 0) << "no jaw opens";
}

TEST(WeightLimits, ATongueThatIsOutOpensTheJawByItself) {
  WeightsClip clip = ClipOf({"tongueOut", "mouthClose", "jawOpen"}, {1, 1, 1});
  LimitWeights(clip);
  EXPECT_NEAR(clip.weights(0, 2), 1 - kTongueOpens, 1e-6);
  EXPECT_EQ(clip.weights(0, 1), clip.weights(0, 2)) << "limited after the jaw";
}

TEST(WeightLimits, LeaveWeightsWithinThem) {
  WeightsClip clip = ClipOf({"eyeBlinkLeft", "eyeSquintLeft", "jawOpen", "mouthClose"}, {0.7f, 1, 0.5f, 0.5f});
  const Eigen::MatrixXf before = clip.weights;
  LimitWeights(clip);
  EXPECT_EQ(clip.weights, before);
}

TEST(WeightLimits, NameArkitTargets) {
  for (const WeightLimit& limit : WeightLimits()) {
    EXPECT_TRUE(FindArkitName(limit.target)) << limit.target;
    for (const auto& term : limit.terms) EXPECT_TRUE(FindArkitName(term.of)) << term.of;
  }
}

}  // namespace
}  // namespace daumier::rig
