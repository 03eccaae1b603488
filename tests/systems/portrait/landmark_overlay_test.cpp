#include "systems/portrait/landmark_overlay.h"

#include "tests/support/expect_error.h"
#include "tests/support/ideal_landmark_network.h"

#include <gtest/gtest.h>

namespace daumier::portrait {
namespace {

TEST(DrawLandmarks, ColoursThePixelsOfTheLandmarksAndNotTheCorners) {
  render::Image image(100, 100, 3, 0);
  const std::vector<float> landmarks = testing::PlausibleLandmarks(20, 20, 60);
  DrawLandmarks(image, landmarks, 1, 1.5, {255, 0, 0});
  for (int i = 0; i < 68; ++i)
    EXPECT_GT(image.at(int(landmarks[2 * size_t(i) + 1]), int(landmarks[2 * size_t(i)]), 0), 100);
  EXPECT_EQ(image.at(2, 2, 0), 0);
  testing::ExpectError([&] { DrawLandmarks(image, std::vector<float>(4), 1); }, "68 of them");
}

TEST(DrawLandmarks, OutsideOfThePictureAreCutOff) {
  render::Image image(20, 20, 3, 0);
  DrawLandmarks(image, testing::PlausibleLandmarks(-500, -500, 1200), 1);
  DrawBox(image, {-5, -5, 90, 90}, 1, {255, 255, 255});
}

TEST(Fitted, KeepsTheProportions) {
  const render::Image image = Fitted(render::Image(50, 200, 1), 100);
  EXPECT_EQ(image.width, 100);
  EXPECT_EQ(image.height, 25);
  EXPECT_EQ(image.channels, 3);
}

TEST(TintedByClasses, LeavesTheBackgroundAndChangesTheRest) {
  const render::Image picture(4, 4, 3, 100);
  render::Image mask(4, 4, 1, 0);
  mask.at(1, 1) = 3;
  const render::Image tinted = TintedByClasses(picture, mask);
  EXPECT_EQ(tinted.at(0, 0, 2), 100);
  EXPECT_GT(tinted.at(1, 1, 2), 150);
  testing::ExpectError([&] { TintedByClasses(picture, render::Image(3, 4, 1)); }, "does not fit a picture of 4 x 4");
}

}  // namespace
}  // namespace daumier::portrait
