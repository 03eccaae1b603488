#include "systems/sketch/pen_line.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::sketch {
namespace {

TEST(PenLine, ADenseLineHasTheWidthsInBetween) {
  const PenLine dense = Densified({{{0, 0}, {4, 0}}, {1, 3}}, 2.5);
  EXPECT_EQ(dense.points, (CanvasPoints{{0, 0}, {2, 0}, {4, 0}}));
  EXPECT_EQ(dense.widths, (std::vector<double>{1, 2, 3}));
  EXPECT_TRUE(Densified({.points = {{0, 0}, {4, 0}}}, 1).widths.empty());
  testing::ExpectError([] { Densified({}, 1); }, "a line has no point");
}

TEST(PenLine, TheWidthAtAShareOfTheLength) {
  const PenLine line{{{0, 0}, {1, 0}, {4, 0}}, {1, 2, 8}};
  EXPECT_DOUBLE_EQ(WidthAtShare(line, 0), 1);
  EXPECT_DOUBLE_EQ(WidthAtShare(line, 0.125), 1.5);
  EXPECT_DOUBLE_EQ(WidthAtShare(line, 0.5), 4);
  EXPECT_DOUBLE_EQ(WidthAtShare(line, 1), 8);
  EXPECT_EQ(WidthAtShare({line.points}, 0.5), 0);
}

TEST(PenLine, WidthsAreReversedAndJoinedWithThePoints) {
  const PenLine line{{{0, 0}, {1, 0}}, {1, 2}};
  const PenLine joined = Joined(line, Reversed(line));
  EXPECT_EQ(joined.points, (CanvasPoints{{0, 0}, {1, 0}, {1, 0}, {0, 0}}));
  EXPECT_EQ(joined.widths, (std::vector<double>{1, 2, 2, 1}));
}

}  // namespace
}  // namespace daumier::sketch
