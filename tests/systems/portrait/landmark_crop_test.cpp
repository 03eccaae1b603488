#include "systems/portrait/landmark_crop.h"

#include "tests/support/expect_error.h"
#include "tests/support/ideal_landmark_network.h"

#include <gtest/gtest.h>

#include <set>

namespace daumier::portrait {
namespace {

TEST(CropFrame, MapsThereAndBack) {
  const CropFrame frame{.centre = {40, 70}, .side = 55, .turn = 0.4, .mirrored = true, .size = 64};
  const Eigen::Vector2d p(12.5, 50);
  EXPECT_NEAR((frame.ToCrop(frame.ToPicture(p)) - p).norm(), 0, 1e-9);
  EXPECT_NEAR((frame.ToPicture({32, 32}) - frame.centre).norm(), 0, 1e-12);
  EXPECT_DOUBLE_EQ(frame.scale(), 55.0 / 64);
}

TEST(CropFrame, TurnsClockwiseAsSeen) {
  const CropFrame frame{.centre = {0, 0}, .side = 10, .turn = M_PI / 2, .size = 10};
  EXPECT_NEAR((frame.ToPicture({10, 5}) - Eigen::Vector2d(0, 5)).norm(), 0, 1e-12);  // Right becomes down.
}

TEST(SampleCrop, OfTheWholePictureIsThePicture) {
  const render::Image picture = testing::PictureOfPlaces(64, 64);
  const std::vector<float> crop = SampleCrop(PicturePyramid(picture), {.centre = {32, 32}, .side = 64, .size = 64}, {});
  for (int row = 0; row < 64; ++row)
    for (int column = 0; column < 64; ++column) {
      EXPECT_NEAR(255 * crop[size_t(64 * row + column)], column, 1e-3);
      EXPECT_NEAR(255 * crop[size_t(64 * 64 + 64 * row + column)], row, 1e-3);
    }
}

TEST(SampleCrop, OfABigPictureIsAMeanOfItsPixels) {
  render::Image picture(256, 256, 3, 0);
  for (int row = 0; row < 256; ++row)
    for (int column = 0; column < 256; ++column)
      for (int k = 0; k < 3; ++k) picture.at(row, column, k) = (row + column) % 2 == 0 ? 255 : 0;
  for (const float value : SampleCrop(PicturePyramid(picture), {.centre = {128, 128}, .side = 256, .size = 32}, {}))
    EXPECT_NEAR(value, 0.5, 0.01);
}

TEST(SampleCrop, OutsideIsContinuedOrOfOneColour) {
  const render::Image picture(16, 16, 1, 51);
  const CropFrame frame{.centre = {8, 8}, .side = 32, .size = 32};
  for (const float value : SampleCrop(PicturePyramid(picture), frame, {})) EXPECT_NEAR(value, 0.2, 1e-6);
  const std::vector<float> crop =
      SampleCrop(PicturePyramid(picture), frame, {.continued = false, .colour = {1, 0, 0.25f}});
  EXPECT_FLOAT_EQ(crop[0], 1);
  EXPECT_FLOAT_EQ(crop[32 * 32], 0);
  EXPECT_FLOAT_EQ(crop[2 * 32 * 32], 0.25f);
  EXPECT_NEAR(crop[32 * 16 + 16], 0.2, 1e-6);
}

TEST(SampleLabels, AreThoseOfThePixelBelowAndNoneOutside) {
  render::Image mask(4, 4, 1, 0);
  mask.at(1, 2) = 5;
  const std::vector<int64_t> labels = SampleLabels(mask, {.centre = {4, 2}, .side = 4, .size = 8}, 4, -100);
  EXPECT_EQ(labels[4], 5);     // Cell (1, 0) lies over pixel (1, 2).
  EXPECT_EQ(labels[6], -100);  // Beyond the right border.
  testing::ExpectError([] { SampleLabels(render::Image(4, 4, 3), {}, 4, 0); }, "has 3 channels, expected 1");
}

TEST(Overlap, IsIntersectionOverUnion) {
  EXPECT_DOUBLE_EQ(Overlap({0, 0, 2, 2}, {1, 0, 3, 2}), 1.0 / 3);
  EXPECT_DOUBLE_EQ(Overlap({0, 0, 1, 1}, {2, 2, 3, 3}), 0);
  EXPECT_DOUBLE_EQ(Overlap({0, 0, 1, 1}, {0, 0, 1, 1}), 1);
}

TEST(MirroredLandmarks, IsAnInvolutionThatKeepsTheMidline) {
  const auto& order = MirroredLandmarks();
  const std::set<int> midline = {8, 27, 28, 29, 30, 33, 51, 57, 62, 66};
  for (int i = 0; i < 68; ++i) {
    EXPECT_EQ(order[size_t(order[size_t(i)])], i);
    EXPECT_EQ(order[size_t(i)] == i, midline.contains(i));
  }
  EXPECT_EQ(order[36], 45);
  EXPECT_EQ(order[48], 54);
  EXPECT_EQ(order[0], 16);
}

TEST(BoxOf, HoldsAllPoints) {
  const std::vector<float> points = {3, 4, 1, 9, 2, -5};
  const Box box = BoxOf(points);
  EXPECT_EQ(box.left, 1);
  EXPECT_EQ(box.top, -5);
  EXPECT_EQ(box.right, 3);
  EXPECT_EQ(box.bottom, 9);
  EXPECT_EQ(box.side(), 14);
  testing::ExpectError([] { BoxOf({}); }, "a box needs a point");
}

}  // namespace
}  // namespace daumier::portrait
