#include "render/styles/colour_planes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace daumier::render {
namespace {

double SumOf(const Plane& plane) {
  return std::accumulate(plane.values.begin(), plane.values.end(), 0.0);
}

TEST(ColourPlanes, ToImageUndoesToPlanes) {
  Image image(3, 5, 3);
  for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<uint8_t>(i * 5);
  EXPECT_EQ(ToImage(ToPlanes(image)), image);
  EXPECT_EQ(ToImage(ToPlanes(Image(2, 2, 1, 7))), Image(2, 2, 3, 7));
}

TEST(Luma, WeighsChannels) {
  EXPECT_NEAR(Luma(MakeColourPlanes(1, 1, {1, 0, 0})).values[0], 0.299f, 1e-6);
  EXPECT_NEAR(Luma(MakeColourPlanes(1, 1, {0.5f, 0.5f, 0.5f})).values[0], 0.5f, 1e-6);
}

TEST(BoxBlur, HasTheMeansWorkedOutByHand) {
  Plane plane(1, 5);
  plane.values = {1, 2, 3, 4, 10};
  const std::vector<float> expected = {1.5f, 2, 3, 17.0f / 3, 7};
  for (size_t i = 0; i < 5; ++i) EXPECT_NEAR(BoxBlur(plane, 1).values[i], expected[i], 1e-6);
  for (const float value : BoxBlur(plane, 9).values) EXPECT_NEAR(value, 4, 1e-5);
  EXPECT_EQ(BoxBlur(plane, 0).values, plane.values);
}

TEST(Blur, SpreadsAPointByItsDeviation) {
  for (const float deviation : {0.8f, 1.5f, 3.0f, 6.0f}) {
    Plane plane(61, 61);
    plane.at(30, 30) = 1;
    const Plane blurred = Blur(plane, deviation);
    EXPECT_NEAR(SumOf(blurred), 1, 1e-4);
    double variance = 0;
    for (int row = 0; row < 61; ++row) {
      for (int column = 0; column < 61; ++column) variance += blurred.at(row, column) * (column - 30) * (column - 30);
    }
    EXPECT_NEAR(std::sqrt(variance), deviation, 0.12 * deviation) << deviation;
  }
}

TEST(SampleAt, IsBilinearAndContinuesOutside) {
  Plane plane(2, 2);
  plane.values = {0, 1, 2, 3};
  EXPECT_EQ(SampleAt(plane, 0.5f, 0.5f), 0);
  EXPECT_EQ(SampleAt(plane, 1, 1), 1.5f);
  EXPECT_EQ(SampleAt(plane, -7, 99), 2);
}

}  // namespace
}  // namespace daumier::render
