#include "systems/sketch/gesture_counts.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::sketch {
namespace {

using datasets::Gesture;

RecognisedGesture Found(Gesture likeliest, bool is_accepted) {
  return {.gesture = is_accepted ? likeliest : Gesture::kNone, .probability = 0.5, .likeliest = likeliest};
}

TEST(GestureCounts, OfFiveStrokes) {
  GestureCounts counts;
  counts.Add(Gesture::kLine, Found(Gesture::kLine, true));
  counts.Add(Gesture::kLine, Found(Gesture::kLine, false));
  counts.Add(Gesture::kRegion, Found(Gesture::kUpRoll1, true));
  counts.Add(Gesture::kNone, Found(Gesture::kRegion, false), "arc");
  counts.Add(Gesture::kNone, Found(Gesture::kRegion, true), "arc");
  EXPECT_NEAR(counts.accuracy(), 2.0 / 3, 1e-12) << "rejection does not count";
  EXPECT_NEAR(counts.accepted(), 2.0 / 3, 1e-12);
  EXPECT_NEAR(counts.accepted_right(), 1.0 / 3, 1e-12);
  EXPECT_NEAR(counts.rejected(), 0.5, 1e-12);
  const Json json = counts.ToJson();
  EXPECT_EQ(json.at("confusion").at("line"), (Json{{"line", 1}, {"none", 1}}));
  EXPECT_EQ(json.at("confusion").at("none"), (Json{{"region", 1}, {"none", 1}}));
  EXPECT_EQ(json.at("none_by_kind").at("arc"), (Json{{"num", 2}, {"accepted", 1}}));
}

TEST(GestureCounts, WithoutStrokesSharesAreNull) {
  EXPECT_TRUE(GestureCounts().ToJson().at("accuracy").is_null());
  EXPECT_TRUE(GestureCounts().ToJson().at("rejected").is_null());
}

TEST(ChooseRejection, IsTheLargestThresholdThatAcceptsTheShare) {
  const std::vector<double> probabilities = {0.9, 0.2, 0.8, 0.4, 0.6};
  EXPECT_EQ(ChooseRejection(probabilities, 0.6).threshold, 0.6);
  EXPECT_EQ(ChooseRejection(probabilities, 0.6).accepted, 0.6);
  EXPECT_EQ(ChooseRejection(probabilities, 0.61).threshold, 0.4);
  EXPECT_EQ(ChooseRejection(probabilities, 1).threshold, 0.2);
  EXPECT_EQ(ChooseRejection({0.5, 0.5, 0.1}, 0.5).accepted, 2.0 / 3);
  testing::ExpectError([] { ChooseRejection({}, 0.97); }, "without validation strokes");
}

}  // namespace
}  // namespace daumier::sketch
