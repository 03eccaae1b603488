#include "render/styles/plane_noise.h"

#include "tests/render/styles/picture_example.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace daumier::render {
namespace {

using daumier::testing::MeanOfPlane;

TEST(PlaneNoise, HasItsRangeAndDeviation) {
  Rng rng(3);
  const Plane smooth = SmoothNoise(50, 70, 9, 5, rng);
  for (const float value : smooth.values) EXPECT_LE(std::abs(value), 1);
  const Plane white = WhiteNoise(101, 99, rng);
  double squares = 0;
  for (const float value : white.values) squares += double(value) * value;
  EXPECT_NEAR(MeanOfPlane(white), 0, 0.03);
  EXPECT_NEAR(squares / double(white.values.size()), 1, 0.04);
  const Plane grain = PaperGrain(64, 64, rng);
  EXPECT_NEAR(MeanOfPlane(grain), 0.5, 0.05);
}

}  // namespace
}  // namespace daumier::render
