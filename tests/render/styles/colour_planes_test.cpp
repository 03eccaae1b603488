#include "render/styles/colour_planes.h"

#include "render/styles/painting.h"
#include "render/styles/plane_noise.h"
#include "tests/support/expect_error.h"

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

TEST(AverageDown, IsTheMeanOfBlocks) {
  Plane plane(2, 4);
  plane.values = {1, 2, 3, 4, 5, 6, 7, 8};
  EXPECT_EQ(AverageDown(plane, 2).values, (std::vector<float>{3.5f, 5.5f}));
  daumier::testing::ExpectError([&] { AverageDown(plane, 3); }, "multiples of 3");
}

TEST(SampleAt, IsBilinearAndContinuesOutside) {
  Plane plane(2, 2);
  plane.values = {0, 1, 2, 3};
  EXPECT_EQ(SampleAt(plane, 0.5f, 0.5f), 0);
  EXPECT_EQ(SampleAt(plane, 1, 1), 1.5f);
  EXPECT_EQ(SampleAt(plane, -7, 99), 2);
}

TEST(PlaneNoise, HasItsRangeAndDeviation) {
  Rng rng(3);
  const Plane smooth = SmoothNoise(50, 70, 9, 5, rng);
  for (const float value : smooth.values) EXPECT_LE(std::abs(value), 1);
  const Plane white = WhiteNoise(101, 99, rng);
  double squares = 0;
  for (const float value : white.values) squares += double(value) * value;
  EXPECT_NEAR(SumOf(white) / double(white.values.size()), 0, 0.03);
  EXPECT_NEAR(squares / double(white.values.size()), 1, 0.04);
  const Plane grain = PaperGrain(64, 64, rng);
  EXPECT_NEAR(SumOf(grain) / (64 * 64), 0.5, 0.05);
}

TEST(Kuwahara, KeepsABorderAndSmoothsBeyond) {
  Rng rng(2);
  ColourPlanes picture = MakeColourPlanes(40, 40, {0.2f, 0.2f, 0.2f});
  const Plane noise = WhiteNoise(40, 40, rng);
  for (Plane& plane : picture) {
    for (int row = 0; row < 40; ++row) {
      for (int column = 0; column < 40; ++column) {
        plane.at(row, column) = (column < 20 ? 0.2f : 0.8f) + 0.05f * noise.at(row, column);
      }
    }
  }
  const ColourPlanes painted = Kuwahara(picture, 2);
  for (int row = 4; row < 36; ++row) {
    EXPECT_NEAR(painted[0].at(row, 18), 0.2f, 0.06);
    EXPECT_NEAR(painted[0].at(row, 21), 0.8f, 0.06);
  }
  EXPECT_EQ(Kuwahara(picture, 0)[1].values, picture[1].values);
}

TEST(FlowAlongForms, IsAlongStripes) {
  Plane stripes(40, 40);
  for (int row = 0; row < 40; ++row) {
    for (int column = 0; column < 40; ++column)
      stripes.at(row, column) = std::sin(0.7f * static_cast<float>(column + row));
  }
  const FlowField flow = FlowAlongForms(stripes, 2);
  EXPECT_NEAR(std::abs(flow.x.at(20, 20)), std::sqrt(0.5f), 0.02);
  EXPECT_LT(flow.x.at(20, 20) * flow.y.at(20, 20), 0) << "row + column is constant";
  EXPECT_GT(flow.strength.at(20, 20), 0.9f);
}

}  // namespace
}  // namespace daumier::render
