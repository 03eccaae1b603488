#include "render/inkml_trace.h"

#include "core/random.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::render {
namespace {

using Eigen::Vector2d;
using TracePoints = std::vector<Vector2d>;

TEST(ParseInkMlTrace, ReadsExplicitValues) {
  EXPECT_EQ(ParseInkMlTrace("10 0, 9 14,\n8 28"), (TracePoints{{10, 0}, {9, 14}, {8, 28}}));
  EXPECT_EQ(ParseInkMlTrace(" -1.5 2e1 ,3-4,.5+6, "), (TracePoints{{-1.5, 20}, {3, -4}, {0.5, 6}}));
  EXPECT_EQ(ParseInkMlTrace("#1F #a"), (TracePoints{{31, 10}}));
  EXPECT_TRUE(ParseInkMlTrace("").empty());
}

TEST(ParseInkMlTrace, AddsUpDifferences) {
  // Worked out by hand: velocities 23 43; then accelerations make them 30 35, 33 30, 40 27.
  EXPECT_EQ(ParseInkMlTrace("1125 18432,'23'43,\"7\"-8,3-5,7-3"),
            (TracePoints{{1125, 18432}, {1148, 18475}, {1178, 18510}, {1211, 18540}, {1251, 18567}}));
  EXPECT_EQ(ParseInkMlTrace("5 5,'1'2,1 2,!9!9,8 8"), (TracePoints{{5, 5}, {6, 7}, {7, 9}, {9, 9}, {8, 8}}));
  EXPECT_EQ(ParseInkMlTrace("5 5,'1 7,2 8"), (TracePoints{{5, 5}, {6, 7}, {8, 8}})) << "each channel has its own order";
}

TEST(ParseInkMlTrace, AStarRepeatsTheLastValueAndAQuestionMarkIsNoPoint) {
  EXPECT_EQ(ParseInkMlTrace("1 2,* 3,4 *"), (TracePoints{{1, 2}, {1, 3}, {4, 3}}));
  EXPECT_EQ(ParseInkMlTrace("0 0,'2'1,* *"), (TracePoints{{0, 0}, {2, 1}, {4, 2}}));
  EXPECT_EQ(ParseInkMlTrace("1 2,? 3,4"), (TracePoints{{1, 2}}));
}

TEST(ParseInkMlTrace, TakesXAndYFromTheirChannels) {
  const InkMlChannels channels{.x = 2, .y = 0, .y_sign = -1};
  EXPECT_EQ(ParseInkMlTrace("7 T 5 99, 8 F 6", channels), (TracePoints{{5, -7}, {6, -8}}));
}

TEST(ParseInkMlTrace, RefusesWhatIsMalformed) {
  for (const char* text : {"1 a", "1 2 ; 3 4", "#", "'", "1e400 0", "nan 0"})
    testing::ExpectError([&] { ParseInkMlTrace(text); }, "is not a value of a trace");
  testing::ExpectError([] { ParseInkMlTrace("1e300 0"); }, "a point of a trace is");
  std::string many;
  for (int i = 0; i < 70; ++i) many += "1 ";
  testing::ExpectError([&] { ParseInkMlTrace(many); }, "more than 64 values");
}

TEST(ParseInkMlTrace, SurvivesAnyText) {
  const std::string letters = "0123456789 ,.-+'\"!*?TF#e\n";
  Rng rng(11);
  for (int i = 0; i < 2000; ++i) {
    std::string text;
    for (uint64_t k = rng.Below(40); k > 0; --k) text += letters[rng.Below(letters.size())];
    try {
      ParseInkMlTrace(text);
    } catch (const Error&) {
    }
  }
}

}  // namespace
}  // namespace daumier::render
