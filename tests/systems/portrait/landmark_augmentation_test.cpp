#include "systems/portrait/landmark_augmentation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <vector>

namespace daumier::portrait {
namespace {

bool AllInRange(std::span<const float> values) {
  return std::ranges::all_of(values, [](float value) { return value >= 0 && value <= 1; });
}

TEST(ChangeColours, StaysInRangeAndIsUnchangedAtStrengthZero) {
  std::vector<float> picture(3 * 64 * 64);
  Rng fill(1);
  for (float& value : picture) value = float(fill.Uniform());
  const std::vector<float> before = picture;
  Rng rng(2);
  ChangeColours(picture, 64, {.strength = 0}, rng);
  EXPECT_EQ(picture, before);
  const LandmarkAugmentationOptions all{.tint = 1,
                                        .grey = 1,
                                        .invert = 1,
                                        .posterise = 1,
                                        .blur = 1,
                                        .coarse = 1,
                                        .noise = 1,
                                        .jpeg = 1,
                                        .line_drawing = 1};
  for (int i = 0; i < 5; ++i) {
    picture = before;
    ChangeColours(picture, 64, all, rng);
    EXPECT_TRUE(AllInRange(picture));
    EXPECT_NE(picture, before);
  }
}

TEST(DrawOccluders, MarkTheCellsThatTheyCover) {
  std::vector<float> picture(3 * 64 * 64, 2.0f);  // No value of a patch.
  std::vector<uint8_t> covered(32 * 32, 0);
  Rng rng(4);
  DrawOccluders(picture, 64, covered, 32, rng);
  int64_t num_covered = 0, num_changed = 0;
  for (const uint8_t cell : covered) num_covered += cell;
  for (size_t i = 0; i < 64 * 64; ++i) num_changed += picture[i] != 2.0f;
  EXPECT_GT(num_covered, 0);
  EXPECT_NEAR(double(num_changed) / (4.0 * double(num_covered)), 1, 0.15);
}

TEST(PaintTeeth, LightensTheMouthAndNothingElse) {
  std::vector<float> picture(3 * 64 * 64, 0.1f);
  std::vector<uint8_t> mouth(32 * 32, 0);
  for (int row = 18; row < 24; ++row)
    for (int column = 10; column < 22; ++column) mouth[size_t(32 * row + column)] = 1;
  Rng rng(4);
  PaintTeeth(picture, 64, mouth, 32, rng);
  int64_t num_light = 0;
  for (int row = 0; row < 64; ++row)
    for (int column = 0; column < 64; ++column) {
      if (picture[size_t(64 * row + column)] == 0.1f) continue;
      ++num_light;
      EXPECT_EQ(mouth[size_t(32 * (row / 2) + column / 2)], 1);
    }
  EXPECT_GT(num_light, 40);
  const std::vector<float> before = picture;
  PaintTeeth(picture, 64, std::vector<uint8_t>(32 * 32, 0), 32, rng);
  EXPECT_EQ(picture, before);
}

}  // namespace
}  // namespace daumier::portrait
