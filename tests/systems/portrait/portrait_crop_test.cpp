#include "systems/portrait/portrait_crop.h"

#include "tests/support/expect_error.h"

#include <cmath>

namespace daumier::portrait {
namespace {

std::vector<float> BoxLandmarks(float left, float top, float right, float bottom) {
  std::vector<float> landmarks;
  for (int n = 0; n < 68; ++n) {
    landmarks.push_back(n % 2 == 0 ? left : right);
    landmarks.push_back(n % 3 == 0 ? top : bottom);
  }
  return landmarks;
}

TEST(PortraitCrop, OfLandmarksPutsTheirBoxInItsPlace) {
  const std::vector<float> landmarks = BoxLandmarks(10, 40, 110, 90);
  const PictureMap map = CropOfLandmarks(landmarks, 0.5);
  const Eigen::Vector2d low = map({10, 40}), high = map({110, 90});
  EXPECT_NEAR(high.x() - low.x(), 112, 1e-9);  // The longer side: half of 224.
  EXPECT_NEAR((low.x() + high.x()) / 2, 112, 1e-9);
  EXPECT_NEAR((low.y() + high.y()) / 2, 0.55 * 224, 1e-9);
}

TEST(PortraitCrop, OfAWholePictureIsCentred) {
  const PictureMap map = CropOfWhole(100, 200);
  EXPECT_TRUE(map({0, 0}).isApprox(Eigen::Vector2d(0, 56)));
  EXPECT_TRUE(map({200, 100}).isApprox(Eigen::Vector2d(224, 168)));
}

TEST(PortraitCrop, MapsComposeAndInvert) {
  Rng rng(3);
  const PictureMap a = DrawJitter({}, rng), b = CropOfWhole(300, 200), both = Compose(a, b);
  const Eigen::Vector2d p(17, 140);
  EXPECT_TRUE(both(p).isApprox(a(b(p))));
  EXPECT_TRUE(both.Inverse()(both(p)).isApprox(p));
}

TEST(PortraitCrop, JitterStaysWithinItsLimits) {
  Rng rng(3);
  const PortraitPictureOptions options{.shift = 7, .scale = 0.2, .rotation = 5};
  for (int i = 0; i < 200; ++i) {
    const PictureMap map = DrawJitter(options, rng);
    EXPECT_LE(std::abs(map.scale() - 1), 0.2 + 1e-9);
    EXPECT_LE(std::abs(map.rotation()), 5 * std::acos(-1.0) / 180 + 1e-9);
    EXPECT_LE((map({112, 112}) - Eigen::Vector2d(112, 112)).cwiseAbs().maxCoeff(), 7 + 1e-9);
  }
}

TEST(WarpPicture, OfTheIdentityIsTheSamePicture) {
  render::Image picture(224, 224, 3);
  for (size_t i = 0; i < picture.pixels.size(); ++i) picture.pixels[i] = uint8_t(i * 7 % 251);
  EXPECT_EQ(WarpPicture(picture, {}), picture);
  EXPECT_EQ(WarpPicture(picture, {}, Sampling::kNearest), picture);
}

TEST(WarpPicture, ShowsWhatTheMapPutsThere) {
  render::Image picture(224, 224, 1, 0);
  picture.at(50, 60) = 200;
  PictureMap map;
  map.shift << 5, -3;
  const render::Image crop = WarpPicture(picture, map);
  EXPECT_EQ(crop.at(47, 65), 200);
  EXPECT_EQ(crop.at(50, 60), 0);
}

TEST(WarpPicture, RepeatsTheBorderAndDoesNotAlias) {
  render::Image picture(1000, 1000, 3, 0);
  for (int row = 0; row < 1000; ++row)
    for (int column = 0; column < 1000; ++column)
      for (int c = 0; c < 3; ++c) picture.at(row, column, c) = (row + column) % 2 == 0 ? 255 : 0;
  const render::Image crop = WarpPicture(picture, CropOfWhole(1000, 1000));
  for (const uint8_t value : crop.pixels) EXPECT_NEAR(value, 127, 20);
  const render::Image beyond = WarpPicture(render::Image(50, 50, 1, 90), {});
  for (const uint8_t value : beyond.pixels) EXPECT_EQ(value, 90);
}

TEST(PortraitCrop, PlanesHoldColoursOneAfterTheOther) {
  render::Image picture(2, 2, 3, 0);
  picture.at(0, 1, 2) = 255;
  const std::vector<float> planes = ColourPlanes(picture);
  EXPECT_EQ(planes.size(), 12U);
  EXPECT_EQ(planes[9], 1);
  EXPECT_EQ(NetworkPicture(render::Image(224, 224, 3, 51), 128).size(), size_t(3 * 128 * 128));
  EXPECT_NEAR(NetworkPicture(render::Image(224, 224, 3, 51), 128)[77], 0.2, 1e-6);
}

TEST(PortraitCrop, RefusesLandmarksThatAreNone) {
  std::vector<float> landmarks(136, 5);
  testing::ExpectError([&] { CropOfLandmarks(landmarks, 0.5); }, "in one point");
  landmarks[7] = NAN;
  testing::ExpectError([&] { CropOfLandmarks(landmarks, 0.5); }, "landmark 3 is not finite");
  landmarks.pop_back();
  testing::ExpectError([&] { CropOfLandmarks(landmarks, 0.5); }, "135 numbers");
  testing::ExpectError([] { WarpPicture({}, {}); }, "an empty picture");
}

TEST(WarpPicture, ShowsAPictureThatIsLessThanAPixel) {
  PictureMap map;
  map.linear *= 1e-6;
  const render::Image crop = WarpPicture(render::Image(300, 200, 3, 70), map);
  EXPECT_EQ(crop.width, kPortraitSide);
  EXPECT_EQ(crop.at(100, 100), 70);
}

}  // namespace
}  // namespace daumier::portrait
