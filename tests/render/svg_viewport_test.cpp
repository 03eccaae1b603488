#include "render/svg_viewport.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::render {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;
using testing::ExpectError;

const SvgUnits kUnits{.font_size = 20.0, .viewport = Vector2d(300, 400), .sheet = Vector2d(30, 40)};

TEST(SvgViewport, LengthsHaveUnits) {
  const auto length = [](std::string_view text) { return ParseSvgLength(text, SvgAxis::kX, kUnits); };
  EXPECT_EQ(length("12"), 12.0);
  EXPECT_EQ(length(" 1.5PX "), 1.5);
  EXPECT_EQ(length("1in"), 96.0);
  EXPECT_NEAR(length("25.4mm"), 96.0, 1e-12);
  EXPECT_NEAR(length("2.54cm"), 96.0, 1e-12);
  EXPECT_NEAR(length("101.6Q"), 96.0, 1e-12);
  EXPECT_EQ(length("72pt"), 96.0);
  EXPECT_EQ(length("6pc"), 96.0);
  EXPECT_EQ(length("2em"), 40.0);
  EXPECT_EQ(length("2rem"), 32.0);
  EXPECT_EQ(length("2ex"), 20.0);
  EXPECT_EQ(length("10vw"), 3.0);
  EXPECT_EQ(length("10vmax"), 4.0);
}

TEST(SvgViewport, PercentagesAreSharesOfTheViewport) {
  EXPECT_EQ(ParseSvgLength("10%", SvgAxis::kX, kUnits), 30.0);
  EXPECT_EQ(ParseSvgLength("10%", SvgAxis::kY, kUnits), 40.0);
  EXPECT_NEAR(ParseSvgLength("10%", SvgAxis::kDiagonal, kUnits), 50.0 / std::sqrt(2.0), 1e-12);
  ExpectError([] { ParseSvgLength("10%", SvgAxis::kX, {}); }, "Add width and height, or a viewBox");
  ExpectError([] { ParseSvgLength("10vh", SvgAxis::kX, {}); }, "Add width and height, or a viewBox");
}

TEST(SvgViewport, RefusesWhatIsNoLength) {
  for (const char* text : {"", "wide", "3 furlongs", "1 2", "NaN", "1e999", "calc(1px)"})
    EXPECT_THROW(ParseSvgLength(text, SvgAxis::kX, kUnits), Error) << text;
}

TEST(SvgViewport, ViewBoxIsFourNumbers) {
  const auto box = ParseSvgViewBox(" -1,2 30 40");
  ASSERT_TRUE(box);
  EXPECT_EQ(box->min(), Vector2d(-1, 2));
  EXPECT_EQ(box->sizes(), Vector2d(30, 40));
  EXPECT_FALSE(ParseSvgViewBox(""));
  ExpectError([] { ParseSvgViewBox("0 0 3"); }, "position 5");
  ExpectError([] { ParseSvgViewBox("0 0 3 0"); }, "expected a positive size");
}

TEST(SvgViewport, AspectRatioPlacesTheBox) {
  // A box of 10 x 10 from (5, 5) in a viewport of 100 x 200 from (1000, 0).
  const AlignedBox2d box(Vector2d(5, 5), Vector2d(15, 15)), viewport(Vector2d(1000, 0), Vector2d(1100, 200));
  const auto corner = [&](std::string_view text) { return Vector2d(PlaceSvgViewBox(box, viewport, text) * box.min()); };
  const auto far_corner = [&](std::string_view text) {
    return Vector2d(PlaceSvgViewBox(box, viewport, text) * box.max());
  };
  EXPECT_EQ(corner(""), Vector2d(1000, 50));
  EXPECT_EQ(far_corner(""), Vector2d(1100, 150));
  EXPECT_EQ(corner("xMidYMid meet"), Vector2d(1000, 50));
  EXPECT_EQ(corner("defer xMaxYMin"), Vector2d(1000, 0));
  EXPECT_EQ(corner("xMinYMax"), Vector2d(1000, 100));
  EXPECT_EQ(corner("xMidYMid slice"), Vector2d(950, 0));
  EXPECT_EQ(corner("xMaxYMid slice"), Vector2d(900, 0));
  EXPECT_EQ(corner("none"), Vector2d(1000, 0));
  EXPECT_EQ(far_corner("none"), Vector2d(1100, 200));
  ExpectError([&] { corner("middle"); }, "preserveAspectRatio is 'middle'");
}

}  // namespace
}  // namespace daumier::render
