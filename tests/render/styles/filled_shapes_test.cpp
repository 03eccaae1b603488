#include "render/styles/filled_shapes.h"

#include "tests/render/styles/picture_example.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace daumier::render {
namespace {

using daumier::testing::MeanOfPlane;

TEST(FilledShapes, HaveTheirAreas) {
  ColourPlanes colours = MakeColourPlanes(60, 60, {0, 0, 0});
  FillEllipse(colours, 30, 30, 20, 10, 0.7f, {{1, 1, 1}});
  EXPECT_NEAR(MeanOfPlane(colours[0]) * 3600, 3.14159 * 200, 12);
  colours = MakeColourPlanes(60, 60, {0, 0, 0});
  FillBox(colours, 30, 30, 12, 7, 0.4f, 0, {{1, 0.5f, 1}});
  EXPECT_NEAR(MeanOfPlane(colours[0]) * 3600, 4 * 84, 4);
  EXPECT_NEAR(MeanOfPlane(colours[1]) * 3600, 2 * 84, 2);
  colours = MakeColourPlanes(4, 2, {0, 0, 0});
  FillBelow(colours, {1, 2.5f}, {{1, 1, 1}});
  EXPECT_EQ(colours[0].values, (std::vector<float>{0, 0, 1, 0, 1, 0.5f, 1, 1}));
  FillEllipse(colours, -500, 900, 3, 3, 0, {{1, 1, 1}});
}

}  // namespace
}  // namespace daumier::render
