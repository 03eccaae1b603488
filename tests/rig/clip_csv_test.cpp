#include "rig/clip_csv.h"

#include "rig/arkit_names.h"
#include "tests/support/expect_error.h"

#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace daumier::rig {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

int Target(const std::string& name) {
  return FindArkitName(name).value();
}

/// A take of Live Link Face: 52 names in the app's order, which differs from Apple's, and 9 turns.
std::string LiveLinkHeader(const std::string& count = "BlendShapeCount") {
  std::vector<std::string> names = {"Timecode", count};
  for (int i = 0; i < kNumArkitNames; ++i) names.push_back(SpellArkitName(i, ArkitSpelling::kPascalCase));
  std::swap(names[17], names[18]);
  std::swap(names[23], names[24]);
  for (const char* part : {"Head", "LeftEye", "RightEye"})
    for (const char* axis : {"Yaw", "Pitch", "Roll"}) names.push_back(std::string(part) + axis);
  return fmt::format("{}\n", fmt::join(names, ","));
}

/// Column k + 2 holds (k + 1) / 100; the turns 0.01, 0.02, ...
std::string LiveLinkRow(const std::string& timecode) {
  std::string row = timecode + ",61";
  for (int k = 0; k < kNumArkitNames; ++k) row += fmt::format(",{:.10f}", (k + 1) / 100.0);
  for (int k = 0; k < 9; ++k) row += fmt::format(",{:.10f}", (k + 1) / 100.0);
  return row + "\n";
}

TEST(ClipCsv, ReadsLiveLinkFaceByTheNamesOfColumns) {
  const Recording recording =
      ParseClipCsv(LiveLinkHeader() + LiveLinkRow("16:41:08:59.500") + LiveLinkRow("16:41:09:00.500"), "a.csv");
  ASSERT_EQ(recording.num_frames(), 2);
  EXPECT_NEAR(recording.seconds[1], 1.0 / 60, 1e-9);
  EXPECT_NEAR(recording.weights(0, Target("eyeBlinkLeft")), 0.01, 1e-7);
  EXPECT_NEAR(recording.weights(0, Target("jawRight")), 0.16, 1e-7);  // The 16th name there, the 17th of Apple's.
  EXPECT_NEAR(recording.weights(0, Target("jawLeft")), 0.17, 1e-7);
  EXPECT_NEAR(recording.weights(0, Target("tongueOut")), 0.52, 1e-7);
}

TEST(ClipCsv, TurnsOfLiveLinkFaceAreMirrored) {
  const Recording recording = ParseClipCsv(LiveLinkHeader() + LiveLinkRow("0:0:0:0"), "a.csv");
  EXPECT_TRUE(recording.head.isApprox(Eigen::RowVector3f(0.02f, -0.01f, -0.03f))) << recording.head;
  EXPECT_TRUE(recording.left_eye.isApprox(Eigen::RowVector3f(0.05f, -0.04f, -0.06f)));
  EXPECT_TRUE(recording.right_eye.isApprox(Eigen::RowVector3f(0.08f, -0.07f, -0.09f)));
  EXPECT_THAT(recording.warnings, Contains(HasSubstr("read as radians: the largest is 0.09")));
}

TEST(ClipCsv, TakesTheRateOfTimecodesFromTheLargestFrame) {
  const std::string header = "Timecode,JawOpen\n";
  const auto last = [&](const std::string& rows) { return ParseClipCsv(header + rows, "a.csv").seconds.back(); };
  EXPECT_NEAR(last("00:00:01:29,0\n00:00:02:00,0\n"), 1.0 / 30, 1e-9);
  EXPECT_NEAR(last("00:00:01:23,0\n00:00:02:00,0\n"), 1.0 / 24, 1e-9);
  EXPECT_NEAR(last("00:00:01:10,0\n00:00:01:13,0\n"), 3.0 / 60, 1e-9) << "no second passes: the app's 60";
  EXPECT_NEAR(last("23:59:59:59,0\n00:00:00:00,0\n"), 1.0 / 60, 1e-9) << "midnight passes";
  EXPECT_NEAR(last("00:00:01.25,0\n00:00:01.75,0\n"), 0.5, 1e-9);
}

TEST(ClipCsv, SkipsRowsWithoutAFace) {
  const Recording recording =
      ParseClipCsv("Timecode,BlendshapeCount,JawOpen\n0:0:0:0,61,0.5\n0:0:0:1,0\n0:0:0:2,61,\n0:0:0:3,61,1\n", "a.csv");
  EXPECT_EQ(recording.num_frames(), 2);
  EXPECT_THAT(recording.warnings, Contains("2 frames without a face are skipped"));
}

TEST(ClipCsv, ReadsWeightsInAnySpellingAndOrder) {
  const Recording recording = ParseClipCsv(
      "\xEF\xBB\xBFtime_ms;mouthSmile_R;blendShapes.JawOpen;EYEBLINKLEFT;frame;cheekRaiser_L\r\n0;0.5;1;0.25;1;9\r\n20;"
      "0;0;0;2;9\r\n",
      "a.csv");
  EXPECT_NEAR(recording.seconds[1], 0.02, 1e-12);
  EXPECT_EQ(recording.weights(0, Target("mouthSmileRight")), 0.5f);
  EXPECT_EQ(recording.weights(0, Target("jawOpen")), 1.0f);
  EXPECT_EQ(recording.weights(0, Target("eyeBlinkLeft")), 0.25f);
  EXPECT_THAT(recording.warnings, Contains("1 unknown name is ignored: cheekRaiser_L"));
  EXPECT_THAT(recording.warnings, Contains(HasSubstr("49 of 52 targets are missing and 0: eyeLookDownLeft, ")));
}

TEST(ClipCsv, WithoutTimesHasSixtyFramesASecond) {
  const Recording recording = ParseClipCsv("jawOpen\n0\n1\n", "a.csv");
  EXPECT_NEAR(recording.seconds[1], 1.0 / 60, 1e-9);
  EXPECT_THAT(recording.warnings, Contains(HasSubstr("60 frames a second are assumed")));
}

TEST(ClipCsv, BadRowsAreErrorsWithTheirLineAndTheRepair) {
  const auto expect = [](const std::string& text, const std::string& part) {
    testing::ExpectError([&] { ParseClipCsv(text, "a.csv"); }, part);
  };
  const std::string header = "time,jawOpen,jawLeft\n";
  expect(header + "0,0,0\n1,0\n", "a.csv: line 3: 2 cells, expected 3 as in the header. The file is cut");
  expect(header + "0,0,x\n", "a.csv: line 2: column jawLeft: 'x' is no number. Correct the cell");
  expect(header + "0,0,nan\n", "'nan' is no number");
  expect(header + "soon,0,0\n", "a.csv: line 2: column time: 'soon' is no time");
  expect(header + "1,0,0\n0.5,0,0\n", "a.csv: line 3: its time is 0.5000 s before");
  expect("Timecode,jawOpen\n0:0:0:1,0\n7,0\n", "a.csv: line 3: '7' is no timecode");
  expect("time,a,b\n0,0,0\n", "a.csv: line 1: no column is an ARKit target (found 'time' first");
  expect("jawOpen,JawOpen\n0,0\n", "'jawOpen' and 'JawOpen' are the same target");
  expect("jawOpen;jawLeft\n0,5;0\n", "decimal comma");
  expect(header, "no row with a face");
  expect("", "a.csv: is empty");
  expect(std::string("a\0b", 3), "is binary");
}

}  // namespace
}  // namespace daumier::rig
