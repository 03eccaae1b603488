#include "rig/recording_builder.h"

#include "rig/arkit_names.h"
#include "tests/support/expect_error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

namespace daumier::rig {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(RecordingBuilder, ClampsWeightsAndStatesTheirRange) {
  RecordingBuilder builder("a.csv");
  const int jaw = builder.FindTarget("JawOpen").value();
  for (const double weight : {-0.25, 0.5, 1.5}) {
    builder.AddFrame(builder.num_frames() + 3, "line 2");
    builder.SetWeight(jaw, weight);
  }
  const Recording recording = builder.Finish(std::nullopt);
  EXPECT_EQ(recording.weights.col(jaw), Eigen::Vector3f(0, 0.5, 1));
  EXPECT_THAT(recording.seconds, ElementsAre(0, 1, 2));
  EXPECT_THAT(recording.warnings,
              Contains(HasSubstr("2 of 156 weights are clamped to 0 .. 1: they range from -0.25 to 1.5")));
}

TEST(RecordingBuilder, NamesMissingAndUnknownTargets) {
  RecordingBuilder builder("a.csv");
  for (int i = 0; i < kNumArkitNames; ++i)
    if (ArkitNames()[size_t(i)] != "tongueOut") builder.FindTarget(ArkitNames()[size_t(i)]);
  EXPECT_EQ(builder.FindTarget("cheekRaiser_L"), std::nullopt);
  builder.AddFrame(0, "line 2");
  EXPECT_THAT(builder.Finish(std::nullopt).warnings,
              ElementsAre("1 of 52 targets is missing and 0: tongueOut", "1 unknown name is ignored: cheekRaiser_L"));
}

/// The largest turn decides on the unit, and turns that are all zero are none.
TEST(RecordingBuilder, ReadsTurnsAsRadiansOrDegreesByTheirRange) {
  for (const double largest : {0.5, 30.0}) {
    RecordingBuilder builder("a.csv");
    builder.FindTarget("jawOpen");
    builder.AddFrame(0, "line 2");
    builder.SetTurn(TurnedPart::kLeftEye, {0, largest, 0});
    const Recording recording = builder.Finish(std::nullopt);
    const double radians = largest > std::numbers::pi ? largest * std::numbers::pi / 180 : largest;
    EXPECT_NEAR(recording.left_eye(0, 1), radians, 1e-6);
    EXPECT_EQ(recording.head.rows(), 0);
    EXPECT_EQ(recording.right_eye.rows(), 0);
    EXPECT_THAT(recording.warnings, Contains(HasSubstr(largest > std::numbers::pi ? "as degrees" : "as radians")));
  }
  RecordingBuilder stated("a.csv");
  stated.FindTarget("jawOpen");
  stated.AddFrame(0, "line 2");
  stated.SetTurn(TurnedPart::kHead, {4, 0, 0});
  const Recording recording = stated.Finish(true);
  EXPECT_NEAR(recording.head(0, 0), 4, 1e-6);
  EXPECT_THAT(recording.warnings, Not(Contains(HasSubstr("radians"))));
}

TEST(RecordingBuilder, TakesTheLaterFrameOfATime) {
  RecordingBuilder builder("a.csv");
  const int jaw = builder.FindTarget("jawOpen").value();
  builder.AddFrame(1, "line 2");
  builder.SetWeight(jaw, 0.25);
  builder.AddFrame(1, "line 3");
  builder.SetWeight(jaw, 0.75);
  const Recording recording = builder.Finish(std::nullopt);
  ASSERT_EQ(recording.num_frames(), 1);
  EXPECT_EQ(recording.weights(0, jaw), 0.75f);
  EXPECT_THAT(recording.warnings, Contains("1 frame is replaced by the next of the same time"));
}

TEST(RecordingBuilder, RefusesTimesThatFallNoTargetsAndNoFrames) {
  RecordingBuilder builder("a.csv");
  testing::ExpectError([&] { RecordingBuilder(builder).Finish(std::nullopt); }, "a.csv: contains no weight");
  builder.FindTarget("jawOpen");
  testing::ExpectError([&] { RecordingBuilder(builder).Finish(std::nullopt); }, "no frame with a face");
  builder.AddFrame(1, "line 2");
  testing::ExpectError([&] { builder.AddFrame(0.5, "line 3"); }, "a.csv: line 3: its time is 0.5000 s before");
}

TEST(SecondsOf, TakesTheUnitFromTheMedianStep) {
  EXPECT_THAT(SecondsOf({0, 0.5, 1}, false), ElementsAre(0, 0.5, 1));
  EXPECT_THAT(SecondsOf({1000, 1033, 1066}, false), ElementsAre(1.0, 1.033, 1.066));
  EXPECT_THAT(SecondsOf({0, 33000, 66000}, false), ElementsAre(0, 0.033, 0.066));
  EXPECT_THAT(SecondsOf({0, 0.5, 1}, true), ElementsAre(0, 0.0005, 0.001));
  EXPECT_THAT(SecondsOf({7}, false), ElementsAre(7));
}

}  // namespace
}  // namespace daumier::rig
