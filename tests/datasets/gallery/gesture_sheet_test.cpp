#include "datasets/gallery/gesture_sheet.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace daumier::datasets {
namespace {

TEST(GestureSheet, HasARowForEachKindOfStroke) {
  const auto strokes = StrokesOfHand({}, {.per_gesture = 3, .none = 2}, 1, 0);
  const render::Image sheet = GestureSheet(strokes, 2), fewer = GestureSheet({strokes[0], strokes[3]}, 2);
  EXPECT_NEAR(sheet.height, fewer.height * 6, fewer.height) << "ten gestures and two other kinds, of one hand";
  EXPECT_GT(sheet.width, 2 * 96);
}

TEST(PictureOfStroke, HasInkOnPaper) {
  const render::Image picture = PictureOfStroke({{0, 0}, {10, 4}});
  EXPECT_EQ(picture.width, 96);
  EXPECT_EQ(*std::ranges::max_element(picture.pixels), 255);
  EXPECT_LT(*std::ranges::min_element(picture.pixels), 50);
}

}  // namespace
}  // namespace daumier::datasets
