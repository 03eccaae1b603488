#include "render/soft_shading.h"

#include "core/error.h"
#include "render/draw.h"
#include "render/strokes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::render {
namespace {

/// A line across a disc of a darkness in [0, 1] whose border is a ramp of a width in pixels.
Image ShadedPicture(double darkness, double ramp) {
  Image image = RasteriseStrokes({{0, {{10, 128}, {246, 120}}}}, 400, {.width = 2.5});
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      const double distance = std::hypot(row - 200.0, column - 200.0);
      const double share = std::clamp((70.0 - distance) / ramp + 0.5, 0.0, 1.0);
      image.at(row, column) = static_cast<uint8_t>(std::lround(image.at(row, column) * (1.0 - darkness * share)));
    }
  }
  return image;
}

TEST(SoftShading, IsTheBrightnessOfASmudgeUnderLines) {
  for (const double darkness : {0.3, 0.6, 0.8}) {
    const auto shading = SoftShading(ShadedPicture(darkness, 40.0));
    ASSERT_TRUE(shading) << darkness;
    EXPECT_NEAR(shading->at(160, 200), 255 * (1.0 - darkness), 3) << "inside";
    EXPECT_NEAR(shading->at(198, 200), 255 * (1.0 - darkness), 6) << "under the line";
    EXPECT_EQ(shading->at(30, 30), 255) << "outside";
  }
}

TEST(SoftShading, AreasWithAnEdgeAndLinesAreNone) {
  EXPECT_FALSE(SoftShading(ShadedPicture(0.6, 1.0)));
  EXPECT_FALSE(SoftShading(ShadedPicture(0.95, 3.0)));
  EXPECT_FALSE(SoftShading(ShadedPicture(0.0, 1.0)));
  EXPECT_FALSE(SoftShading(Image(300, 300, 1, 255)));
  EXPECT_FALSE(SoftShading(Image(1, 1, 1, 0)));
}

TEST(SoftShading, RefusesColour) {
  EXPECT_THROW(SoftShading(Image(4, 4, 3)), Error);
}

}  // namespace
}  // namespace daumier::render
