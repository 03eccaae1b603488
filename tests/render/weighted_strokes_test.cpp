#include "render/weighted_strokes.h"

#include "core/files.h"
#include "render/svg.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::render {
namespace {

using testing::ExpectError;

WeightedStroke Weighted(std::vector<std::array<float, 2>> points, std::vector<float> widths) {
  return {{0, std::move(points)}, std::move(widths)};
}

TEST(PartsByWidth, AStrokeOfOneWidthIsOnePart) {
  const auto parts = PartsByWidth(Weighted({{0, 0}, {5, 5}, {9, 0}}, {2.6f, 2.6f, 2.6f}));
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].stroke.points.size(), 3u);
  EXPECT_FLOAT_EQ(float(parts[0].width), 2.6f);
  EXPECT_EQ(PartsByWidth(Weighted({{0, 0}, {5, 5}}, {}))[0].width, StrokeStyle{}.width);
  EXPECT_EQ(PartsByWidth(Weighted({{0, 0}, {5, 5}}, {0, 0}))[0].width, StrokeStyle{}.width);
  EXPECT_TRUE(PartsByWidth(Weighted({}, {})).empty());
}

TEST(PartsByWidth, AChangeOfWidthIsDividedIntoSteps) {
  // From 1 to 2 in four pieces, whose middles are 1.125, 1.375, ...: rounded to 1.25, 1.5, 1.75, 2.
  const auto parts = PartsByWidth(Weighted({{0, 0}, {8, 0}}, {1, 2}));
  ASSERT_EQ(parts.size(), 4u);
  for (size_t k = 0; k < parts.size(); ++k) {
    EXPECT_NEAR(parts[k].width, 1.125 + 0.25 * double(k), kWidthStep / 2 + 1e-9);
    EXPECT_EQ(parts[k].stroke.points, (std::vector<std::array<float, 2>>{{2.0f * k, 0}, {2.0f * (k + 1), 0}}));
  }
}

TEST(PartsByWidth, HasABoundedNumberOfPieces) {
  EXPECT_LE(PartsByWidth(Weighted({{0, 0}, {8, 0}}, {1, 1e9f})).size(), size_t(kMostPartsOfSegment));
}

TEST(PartsByWidth, RefusesWhatIsNoWidth) {
  ExpectError([] { PartsByWidth(Weighted({{0, 0}, {1, 0}}, {1})); }, "1 widths of 2 points");
  ExpectError([] { PartsByWidth(Weighted({{0, 0}}, {-1})); }, "the width -1");
  ExpectError([] { PartsByWidth(Weighted({{0, 0}}, {NAN})); }, "the width nan");
}

TEST(RasteriseWeighted, WithoutWidthsIsAsRasteriseStrokes) {
  const std::vector<Stroke> strokes = {{0, {{50, 100}, {200, 130}}}, {0, {{10, 20}}}};
  std::vector<WeightedStroke> weighted;
  for (const Stroke& stroke : strokes) weighted.push_back({stroke, {}});
  EXPECT_EQ(RasteriseWeighted(weighted, 256).pixels, RasteriseStrokes(strokes, 256).pixels);
}

TEST(RasteriseWeighted, EachStrokeHasItsWidth) {
  const Image image = RasteriseWeighted(
      {Weighted({{50, 100.5f}, {200, 100.5f}}, {6, 6}), Weighted({{50, 150.5f}, {200, 150.5f}}, {})}, 256);
  EXPECT_EQ(image.at(97, 120), 128) << "three pixels from the middle: half covered";
  EXPECT_EQ(image.at(98, 120), 0);
  EXPECT_EQ(image.at(148, 120), 255);
}

TEST(MapWeighted, WidthsAreScaledAsPointsAre) {
  const auto mapped = MapWeighted({Weighted({{1, 2}, {3, 4}}, {1, 2})}, {2, {10, 0}});
  EXPECT_EQ(mapped[0].points, (std::vector<std::array<float, 2>>{{12, 4}, {16, 8}}));
  EXPECT_EQ(mapped[0].widths, (std::vector<float>{2, 4}));
}

TEST(WriteWeightedSvg, APathForEachPart) {
  const testing::TempDir folder;
  const auto file = folder.path() / "a.svg";
  WriteWeightedSvg(file, {Weighted({{1, 2}, {3, 4}}, {3, 3}), Weighted({{0, 0}, {8, 0}}, {1, 2})}, {"line"});
  EXPECT_NE(ReadFile(file).find("stroke-width=\"3\""), std::string::npos);
  const Drawing drawing = ReadSvg(file, {"line"});
  ASSERT_EQ(drawing.strokes.size(), 5u);
  EXPECT_EQ(drawing.strokes[0].points, (std::vector<std::array<float, 2>>{{1, 2}, {3, 4}}));
}

}  // namespace
}  // namespace daumier::render
