#include "render/styles/painting.h"

#include "render/styles/plane_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace daumier::render {
namespace {

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

TEST(BrushPainting, KeepsColoursNearTheirs) {
  Rng rng(5);
  const ColourPlanes painted = BrushPainting(MakeColourPlanes(50, 60, {0.6f, 0.4f, 0.3f}), 3, rng);
  for (const float value : painted[1].values) EXPECT_NEAR(value, 0.4f, 0.13f);
}

}  // namespace
}  // namespace daumier::render
