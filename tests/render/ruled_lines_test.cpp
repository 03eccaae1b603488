#include "render/ruled_lines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace daumier::render {
namespace {

/// Lines two pixels wide at multiples of a distance from the middle of a mask of 300 x 400.
Image MaskOfLines(double distance, double angle) {
  Image mask(300, 400, 1, 0);
  for (int row = 0; row < mask.height; ++row) {
    for (int column = 0; column < mask.width; ++column) {
      const double v = (row + 0.5 - 150) * std::cos(angle) - (column + 0.5 - 200) * std::sin(angle);
      if (std::abs(std::remainder(v, distance)) <= 1.0) mask.at(row, column) = 255;
    }
  }
  return mask;
}

TEST(LinesNearRows, FindsAngleAndPlace) {
  for (const double degrees : {0.0, 3.0, -9.0}) {
    const double angle = degrees * std::numbers::pi / 180;
    const auto lines = LinesNearRows(MaskOfLines(20.0, angle));
    ASSERT_GE(lines.size(), 11U) << degrees;
    for (const RuledLine& line : lines) {
      EXPECT_NEAR(line.angle, angle, 0.004);
      EXPECT_NEAR(std::remainder(line.v, 20.0), 0.0, 0.7);
      EXPECT_GE(line.cover, 0.9);
    }
  }
}

TEST(LinesNearRows, NoneInAnEmptyOrAFullMask) {
  EXPECT_TRUE(LinesNearRows(Image(100, 100, 1, 0)).empty());
  EXPECT_TRUE(LinesNearRows(Image(100, 100, 1, 255)).empty());
}

std::vector<RuledLine> LinesAtPlaces(const std::vector<double>& places) {
  std::vector<RuledLine> lines;
  for (const double v : places) lines.push_back({.v = v});
  return lines;
}

TEST(RegularLines, LeavesOutWhatIsBetween) {
  const auto regular = RegularLines(LinesAtPlaces({0, 20, 33, 40.5, 60, 100, 107, 120}));
  std::vector<double> places;
  for (const RuledLine& line : regular) places.push_back(line.v);
  EXPECT_EQ(places, (std::vector<double>{0, 20, 40.5, 60, 100, 120}));
}

TEST(RegularLines, FourAreNoRuling) {
  EXPECT_TRUE(RegularLines(LinesAtPlaces({0, 20, 40, 60})).empty());
  EXPECT_TRUE(RegularLines({}).empty());
  EXPECT_TRUE(RegularLines(LinesAtPlaces({0, 3, 6, 9, 12, 15})).empty()) << "too near to each other";
}

}  // namespace
}  // namespace daumier::render
