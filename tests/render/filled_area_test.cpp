#include "render/filled_area.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace daumier::render {
namespace {

std::vector<Eigen::Vector2d> SquareOutline(double low, double high) {
  return {{low, low}, {high, low}, {high, high}, {low, high}};
}

int64_t NumFilled(const FilledArea& area, const MaskFrame& frame = {}) {
  Image mask(10, 10, 1, 255);
  FillArea(area, frame, 0, mask);
  return std::count(mask.pixels.begin(), mask.pixels.end(), 0);
}

TEST(FillArea, SetsThePixelsWhoseCentresAreInside) {
  EXPECT_EQ(NumFilled({{SquareOutline(2, 5)}}), 9);
  EXPECT_EQ(NumFilled({{SquareOutline(2.6, 5)}}), 4);
  EXPECT_EQ(NumFilled({{SquareOutline(2, 5)}}, {{1, 1}, 2.0}), 36);
  EXPECT_EQ(NumFilled({{SquareOutline(-90, 5)}}), 25) << "cut off at the border";
}

TEST(FillArea, RuleDecidesWhereOutlinesOverlap) {
  const auto outer = SquareOutline(0, 8), inner = SquareOutline(2, 4);
  EXPECT_EQ(NumFilled({{outer, inner}, FillRule::kNonzero}), 64);
  EXPECT_EQ(NumFilled({{outer, inner}, FillRule::kEvenOdd}), 60);
  EXPECT_EQ(NumFilled({{outer, {inner.rbegin(), inner.rend()}}, FillRule::kNonzero}), 60);
}

TEST(FillArea, RefusesPointsThatAreNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  testing::ExpectError([&] { NumFilled({{{{0, 0}, {nan, 1}, {1, 1}}}}); }, "not finite");
}

}  // namespace
}  // namespace daumier::render
