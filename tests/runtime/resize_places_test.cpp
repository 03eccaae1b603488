#include "runtime/resize_places.h"

#include "tests/support/expect_error.h"

namespace daumier::runtime {
namespace {

using Places = std::vector<double>;
using Pixels = std::vector<int64_t>;

TEST(ResizePlaces, FollowTheFormulaOfEachMode) {
  const ResizedAxis twice{2, 4, 2};
  EXPECT_EQ(PlacesOfPixels(twice, "asymmetric"), (Places{0, 0.5, 1, 1.5}));
  EXPECT_EQ(PlacesOfPixels(twice, "half_pixel"), (Places{-0.25, 0.25, 0.75, 1.25}));
  EXPECT_EQ(PlacesOfPixels(twice, "half_pixel_symmetric"), (Places{-0.25, 0.25, 0.75, 1.25}));
  EXPECT_EQ(PlacesOfPixels(twice, "tf_half_pixel_for_nn"), (Places{0.25, 0.75, 1.25, 1.75}));
  EXPECT_EQ(PlacesOfPixels({2, 3, 1.5f}, "align_corners"), (Places{0, 0.5, 1}));
  EXPECT_EQ(PlacesOfPixels({7, 1, 1.0f / 7}, "pytorch_half_pixel"), Places{0});
  EXPECT_EQ(PlacesOfPixels({7, 1, 1.0f / 7}, "align_corners"), Places{0});
  // 5 pixels by 1.3 are 6: the image is kept in the middle.
  EXPECT_NEAR(PlacesOfPixels({5, 6, 1.3f}, "half_pixel_symmetric")[0], 2.5 * (1 - 6 / 6.5) + 0.5 / 1.3 - 0.5, 1e-6);
  testing::ExpectError([&] { PlacesOfPixels(twice, "tf_crop_and_resize"); }, "there is no resizing at");
}

TEST(ResizePlaces, NearestPixelsRoundAsTheyAreAsked) {
  const ResizedAxis twice{2, 4, 2};
  EXPECT_EQ(NearestPixels(twice, "asymmetric", "floor"), (Pixels{0, 0, 1, 1}));
  EXPECT_EQ(NearestPixels(twice, "asymmetric", "ceil"), (Pixels{0, 1, 1, 1}));
  EXPECT_EQ(NearestPixels(twice, "asymmetric", "round_prefer_floor"), (Pixels{0, 0, 1, 1}));
  EXPECT_EQ(NearestPixels(twice, "asymmetric", "round_prefer_ceil"), (Pixels{0, 1, 1, 1}));
  EXPECT_EQ(NearestPixels({6, 2, 1.0f / 3}, "asymmetric", "floor"), (Pixels{0, 3}));
  testing::ExpectError([&] { NearestPixels(twice, "asymmetric", "up"); }, "there is no nearest pixel by 'up'");
}

TEST(ResizePlaces, LinearAndCubicWeightsSumToOneWithinTheImage) {
  const ResizedAxis axis{3, 7, 7.0f / 3};
  for (const Between& pixel : LinearPixels(axis, "half_pixel")) {
    EXPECT_TRUE(pixel.first >= 0 && pixel.second < 3 && pixel.share >= 0 && pixel.share <= 1);
  }
  for (const bool excludes : {false, true}) {
    for (const CubicPixel& pixel : CubicPixels(axis, "half_pixel", -0.75, excludes)) {
      float sum = 0;
      for (int i = 0; i < 4; ++i) {
        sum += pixel.weights[i];
        EXPECT_TRUE(pixel.pixels[i] >= 0 && pixel.pixels[i] < 3);
      }
      EXPECT_NEAR(sum, 1, 1e-6);
    }
  }
}

}  // namespace
}  // namespace daumier::runtime
