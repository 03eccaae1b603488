#include "render/svg_rings.h"

#include <gtest/gtest.h>

namespace daumier::render {
namespace {

const SvgPolyline kClosedBox{{{1, 2}, {5, 2}, {5, 4}, {1, 4}, {1, 2}}};

TEST(SvgRings, Boxes) {
  EXPECT_EQ(BoxOfLine(kClosedBox).sizes(), Eigen::Vector2d(4, 2));
  EXPECT_EQ(BoxOfLines({kClosedBox, {{{9, 9}}}}).max(), Eigen::Vector2d(9, 9));
  EXPECT_TRUE(BoxOfLine({}).isEmpty());
  EXPECT_TRUE(BoxOfLines({}).isEmpty());
}

TEST(SvgRings, OnlyRectanglesHaveTheirBox) {
  ASSERT_TRUE(RectangleOf(kClosedBox).has_value());
  EXPECT_EQ(RectangleOf(kClosedBox)->sizes(), Eigen::Vector2d(4, 2));
  EXPECT_FALSE(RectangleOf({{{1, 2}, {5, 2}, {5, 4}, {1, 4}}}).has_value()) << "open";
  EXPECT_FALSE(RectangleOf({{{0, 1}, {1, 0}, {2, 1}, {1, 2}, {0, 1}}}).has_value()) << "a diamond covers half";
  EXPECT_FALSE(RectangleOf({}).has_value());
}

TEST(SvgRings, StraightLinesHaveNoInside) {
  EXPECT_TRUE(HasInside(kClosedBox));
  EXPECT_FALSE(HasInside({}));
  EXPECT_FALSE(HasInside({{{0.1, 0.1}, {0.2, 0.2}, {0.3, 0.3}, {0.1, 0.1}}}));
  EXPECT_TRUE(HasInside({{{0, 0}, {10, 0.01}, {20, 0}}}));
  EXPECT_TRUE(HasInside({{{0, 0}, {2, 2}, {2, 0}, {0, 2}, {0, 0}}})) << "an eight, whose signed area is 0";
}

}  // namespace
}  // namespace daumier::render
