#include "render/stroke_samples.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::render {
namespace {

TEST(StrokeSamples, LieAtEqualLengthsAlongAllStrokes) {
  // 10 to the right, a dot, then 30 down in two pieces: 8 points 5 apart, the first at 2.5.
  const std::vector<Stroke> strokes{{0, {{0, 0}, {10, 0}}}, {0, {{99, 99}}}, {0, {{50, 20}, {50, 40}, {50, 50}}}};
  const auto samples = SampleStrokes(strokes, 8);
  ASSERT_EQ(samples.size(), 8u);
  const float expected[8][2] = {{2.5, 0},   {7.5, 0},   {50, 22.5}, {50, 27.5},
                                {50, 32.5}, {50, 37.5}, {50, 42.5}, {50, 47.5}};
  for (size_t i = 0; i < 8; ++i) {
    EXPECT_NEAR(samples[i].x, expected[i][0], 1e-5) << i;
    EXPECT_NEAR(samples[i].y, expected[i][1], 1e-5) << i;
    EXPECT_NEAR(samples[i].cos_double, i < 2 ? 1 : -1, 1e-6) << i;
    EXPECT_NEAR(samples[i].sin_double, 0, 1e-6) << i;
  }
}

TEST(StrokeSamples, LineIsTheSameInBothSenses) {
  const auto there = SampleStrokes({{0, {{0, 0}, {3, 4}}}}, 1), back = SampleStrokes({{0, {{3, 4}, {0, 0}}}}, 1);
  EXPECT_NEAR(there[0].cos_double, (9.0 - 16) / 25, 1e-6);
  EXPECT_NEAR(there[0].sin_double, 24.0 / 25, 1e-6);
  EXPECT_NEAR(back[0].cos_double, there[0].cos_double, 1e-6);
  EXPECT_NEAR(back[0].sin_double, there[0].sin_double, 1e-6);
}

TEST(StrokeSamples, RowsAreOverTheCanvasFromMinusOneToOne) {
  // Points at (64, 0) and (192, 0), along x.
  const std::vector<float> expected{-0.5f, 0.5f, -1, -1, 1, 1, 0, 0};
  EXPECT_EQ(SampleRows({{0, {{0, 0}, {256, 0}}}}, 2), expected);
}

TEST(StrokeSamples, RefusesADrawingWithoutLength) {
  testing::ExpectError([] { SampleStrokes({{0, {{1, 1}}}, {0, {{2, 2}, {2, 2}}}}, 4); }, "no stroke");
  testing::ExpectError([] { SampleStrokes({{0, {{1, 1}, {2, 2}}}}, 0); }, "0 points");
}

}  // namespace
}  // namespace daumier::render
