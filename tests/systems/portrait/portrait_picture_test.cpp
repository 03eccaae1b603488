#include "systems/portrait/portrait_picture.h"

#include "core/picture_parts.h"
#include "tests/support/expect_error.h"
#include "tests/support/small_portraits.h"

#include <cmath>

namespace daumier::portrait {
namespace {

TEST(FacePainter, PaintsTheFaceWhereTheCameraSeesIt) {
  const faces::MorphableModel model = testing::SyntheticMorphable();
  const FacePainter painter(model);
  std::vector<float> x(faces::kNumCoefficients);
  x[size_t(faces::kPoseSlot.first + 5)] = -40;
  const FacePicture face = painter.Paint(x);
  const auto coverage = [&](double px, double py) { return face.colours[4 * (size_t(py) * 224 + size_t(px)) + 3]; };
  EXPECT_EQ(coverage(face.landmarks[2 * 30], face.landmarks[2 * 30 + 1]), 1);
  EXPECT_EQ(coverage(2, 2), 0);
  // Without light of its own the shade is 0.709 of the albedo.
  const size_t chin = size_t(face.landmarks[2 * 8 + 1] - 3) * 224 + size_t(face.landmarks[2 * 8]);
  EXPECT_NEAR(face.colours[4 * chin], 0.709 * 0.75, 0.02);
  testing::ExpectError([&] { painter.Paint(std::vector<float>(12)); }, "12 coefficients");
}

TEST(PhotometricError, IsTheSumOverColoursWhereTheFaceShows) {
  FacePicture face{std::vector<float>(size_t(4 * 224 * 224)), {}};
  render::Image crop(224, 224, 3, 51);
  std::vector<float> shown(224 * 224, 0);
  for (const size_t i : {10U, 11U, 12U}) {
    face.colours[4 * i] = 0.5F;
    face.colours[4 * i + 3] = i == 12 ? 0.6F : 1;
    shown[i] = i == 11 ? 0 : 1;
  }
  EXPECT_NEAR(PhotometricError(face, crop, shown), 0.3 + 0.2 + 0.2, 1e-6);  // Of pixel 10 alone.
  EXPECT_TRUE(std::isnan(PhotometricError(face, crop, std::vector<float>(224 * 224))));
}

TEST(OverlayFace, LaysTheFaceOverThePicture) {
  FacePicture face{std::vector<float>(size_t(4 * 224 * 224)), {}};
  face.colours[0] = 1, face.colours[3] = 1;
  const render::Image over = OverlayFace(render::Image(224, 224, 3, 100), face);
  EXPECT_EQ(over.at(0, 0, 0), 255);
  EXPECT_EQ(over.at(0, 0, 1), 0);
  EXPECT_EQ(over.at(0, 1, 1), 100);
  const render::Image half = OverlayFace(render::Image(224, 224, 3, 100), face, 0.5);
  EXPECT_EQ(half.at(0, 0, 0), 178);  // (255 + 100) / 2, rounded.
  EXPECT_EQ(half.at(0, 0, 1), 50);
}

TEST(PhotometricError, RefusesPicturesOfAnotherSize) {
  const FacePicture face{std::vector<float>(size_t(4 * 224 * 224)), {}};
  testing::ExpectError([&] { PhotometricError(face, render::Image(10, 10, 3), std::vector<float>(224 * 224)); },
                       "a crop of 300 numbers");
}

TEST(DotsOver, MarksLandmarksAndSkipsThoseOutside) {
  const render::Image picture(40, 80, 3, 100);
  const render::Image dots = DotsOver(picture, std::vector<float>{50, 20, NAN, 3, 500, -7}, {9, 8, 7});
  EXPECT_EQ(dots.at(20, 50, 0), 9);
  EXPECT_EQ(dots.at(19, 49, 1), 8);
  EXPECT_EQ(dots.at(20, 53, 1), 100);
  int num_marked = 0;
  for (size_t p = 0; p < dots.pixels.size(); p += 3) num_marked += dots.pixels[p] != 100;
  EXPECT_GE(num_marked, 4);
  EXPECT_LE(num_marked, 12);  // A disc of 1.5 pixels.
}

TEST(FaceMask, IsSkinBrowsLipsAndEars) {
  render::Image classes(1, kNumPictureClasses, 1);
  for (int c = 0; c < kNumPictureClasses; ++c) classes.at(0, c) = uint8_t(c);
  EXPECT_EQ(FaceMask(classes), (std::vector<float>{0, 1, 1, 0, 1, 0, 1, 0}));
}

}  // namespace
}  // namespace daumier::portrait
