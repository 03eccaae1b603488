#include "fitting/texture_eyes.h"

#include "faces/eyeball.h"
#include "tests/fitting/drawn_eye.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace daumier::fitting {
namespace {

/// An eyeball of 1.2 cm in an atlas of its own.
rig::TextureSpace EyeSpace() {
  rig::TextureSpace space;
  const auto& triangles = faces::EyeballTopology().triangles;
  space.triangles.resize(Eigen::Index(triangles.size()), 3);
  for (size_t t = 0; t < triangles.size(); ++t) space.triangles.row(Eigen::Index(t)) = triangles[t].transpose();
  space.uv = faces::EyeballUv();
  space.uv_triangles = space.triangles;
  space.charts.assign(triangles.size(), rig::TextureChart::kLeftEye);
  return space;
}

const Eigen::Vector3f kPaleSkin(0.8F, 0.7F, 0.6F);

ShownEye EyeAt(const geometry::Vector3& centre) {
  return {centre, Eigen::Matrix3d::Identity(),
          faces::EyeballPoints({.centre = {0, 0, 0}, .radii = {1.2, 1.2, 1.2}, .iris_radius = 0.45, .bulge = 0})};
}

/// 40 pixels a cm at the origin's depth, which is the picture's middle.
PictureCamera EyeCamera() {
  PictureCamera camera;
  camera.linear *= 40 / 10.15;
  camera.shift = Eigen::Vector2d::Constant(kEyeSide / 2 - 112 * 40 / 10.15);
  return camera;
}

TEST(TurnToIris, BringsThePoleToTheDisc) {
  const PictureCamera camera = EyeCamera();
  ShownEye eye = EyeAt({0.1, -0.2, 1});
  eye.rotation = RotationOf((PortraitPose() << 0.1, 0.3, -0.2, 0, 0, 0).finished());
  const IrisDisc iris{{92, 70}, 12};
  const Eigen::Matrix3d turn = TurnToIris(eye, camera, iris);
  EXPECT_NEAR(turn.determinant(), 1, 1e-9);
  const geometry::Points pole = (eye.centre + eye.rotation * turn * geometry::Vector3(0, 0, 1.2)).transpose();
  EXPECT_TRUE(camera.PlacesOf(pole).row(0).isApprox(Eigen::RowVector2d(92, 70), 1e-6)) << camera.PlacesOf(pole);
}

TEST(TurnToIris, IsAtMost35Degrees) {
  const Eigen::Matrix3d turn = TurnToIris(EyeAt({0, 0, 0}), EyeCamera(), {{500, 80}, 12});
  EXPECT_NEAR(std::acos(turn(2, 2)) * 180 / std::acos(-1.0), 35, 1e-6);
  EXPECT_GT(turn(0, 2), 0) << "to the right of the picture";
}

class PaintedEye : public ::testing::Test {
 protected:
  std::vector<Eigen::Vector3f> Painted(const PictureLayer& layer, float shade, Gaze gaze = Gaze::kAhead) const {
    const ShownEye eye = EyeAt({0, 0, 0});
    return PaintEye(chart_, eye, EyeCamera(), layer, FindLooks(std::array{eye}, EyeCamera(), layer, kPaleSkin)[0],
                    shade, gaze);
  }
  /// The colour of the texel at a direction (x, y across the axis, in radii), in front.
  Eigen::Vector3f At(const std::vector<Eigen::Vector3f>& colours, double x, double y, bool is_front = true) const {
    const ShownEye eye = EyeAt({0, 0, 0});
    double nearest = 1e9;
    Eigen::Vector3f colour;
    for (size_t i = 0; i < colours.size(); ++i) {
      geometry::Vector3 point = geometry::Vector3::Zero();
      for (int k = 0; k < 3; ++k)
        point += double(chart_.weights[i][k]) * eye.points.row(chart_.corners(chart_.triangles[i], k)).transpose();
      const double distance =
          (point / 1.2 - geometry::Vector3(x, y, (is_front ? 1 : -1) * std::sqrt(1 - x * x - y * y))).norm();
      if (distance < nearest) nearest = distance, colour = colours[i];
    }
    EXPECT_LT(nearest, 0.2);
    return colour;
  }

  const rig::TextureSpace space_ = EyeSpace();
  const EyeChart chart_ = MakeEyeChart(space_, space_.Rasterise(128), rig::TextureChart::kLeftEye);
};

TEST_F(PaintedEye, HasTheIrisInFrontAndWhiteAround) {
  // The picture's eye looks to its right.
  const auto colours = Painted(DrawnEye({80, 80}, {{94, 80}, 14}), 1);
  EXPECT_NEAR(At(colours, 0, 0)[2], 0.5, 0.05);
  EXPECT_NEAR(At(colours, 0.1, 0.1)[0], 0.1, 0.05);
  EXPECT_NEAR(At(colours, -0.6, 0)[0], 0.8, 0.05) << "seen white";
  EXPECT_GT(At(colours, 0, 0.95)[0], 0.8) << "white where unseen";
}

TEST_F(PaintedEye, CompletesAnIrisThatALidHides) {
  const auto colours = Painted(DrawnEye({80, 80}, {{80, 80}, 15}, 78), 1);
  EXPECT_NEAR(At(colours, 0, 0.18)[2], 0.5, 0.06);
  EXPECT_NEAR(At(colours, 0, 0.18)[0], 0.1, 0.06);
}

TEST_F(PaintedEye, IsPlainWhereThePictureShowsNone) {
  const auto colours = Painted(DrawnEye({80, 80}, {{80, 80}, 15}, 200), 1);
  EXPECT_LT(At(colours, 0, 0).maxCoeff(), 0.1) << "pupil";
  EXPECT_NEAR(At(colours, 0.25, 0)[0], 0.36, 0.03) << "iris";
  EXPECT_GT(At(colours, 0.7, 0).minCoeff(), 0.9) << "white";
}

TEST_F(PaintedEye, IsDividedByTheShade) {
  const PictureLayer layer = DrawnEye({80, 80}, {{80, 80}, 15});
  const auto plain = Painted(layer, 1);
  const auto shaded = Painted(layer, 0.8F);
  EXPECT_TRUE(At(shaded, 0, 0).isApprox(At(plain, 0, 0) / 0.8F, 1e-3F));
}

TEST_F(PaintedEye, LooksWhereThePictureShowsItIfTheGazeIsKept) {
  const auto layer = DrawnEye({80, 80}, {{94, 80}, 14});
  const auto colours = Painted(layer, 1, Gaze::kShown);
  EXPECT_NEAR(At(colours, 14 / 48.0, 0)[0], 0.1, 0.05) << "the iris";
  EXPECT_NEAR(At(colours, -0.2, 0)[0], 0.8, 0.05) << "white";
}

TEST_F(PaintedEye, HasLighterWhitesThanAShadowedPicture) {
  PictureLayer layer = DrawnEye({80, 80}, {{80, 80}, 14});
  for (float& value : layer.colours)
    if (value > 0.7F) value = 0.4F;
  const auto colours = Painted(layer, 1);
  EXPECT_NEAR(At(colours, 0.5, 0)[0], 0.6, 0.05);
}

TEST_F(PaintedEye, LeavesOutTheShadowOfALid) {
  PictureLayer layer = DrawnEye({80, 80}, {{80, 84}, 12});
  for (int row = 0; row < 68; ++row)
    for (int column = 0; column < kEyeSide; ++column)
      for (size_t k = 0; k < 3; ++k) layer.colours[3 * (size_t(row) * kEyeSide + size_t(column)) + k] = 0.2F;
  const auto colours = Painted(layer, 1);
  EXPECT_GT(At(colours, -0.5, 0.3)[0], 0.7);
}

TEST(FindLooks, TakesNoLidForAnIris) {
  const std::array shown = {EyeAt({0, 0, 0})};
  PictureLayer layer = DrawnEye({80, 80}, {{84, 80}, 17});
  EXPECT_FALSE(FindLooks(shown, EyeCamera(), layer, {0.11F, 0.2F, 0.5F})[0].disc)
      << "as light as the skin, and of its hue";
}

TEST_F(PaintedEye, HasTheColourOfDarkGlasses) {
  PictureLayer layer = DrawnEye({80, 80}, {{300, 300}, 1});
  for (size_t i = 0; i < layer.colours.size(); ++i) layer.colours[i] = i % 3 == 0 ? 0.12F : 0.1F;
  const auto colours = Painted(layer, 0.8F);
  EXPECT_TRUE(At(colours, 0, 0).isApprox(Eigen::Vector3f(0.12F, 0.1F, 0.1F) / 0.8F, 1e-4F));
  EXPECT_TRUE(At(colours, 0.6, 0).isApprox(At(colours, 0, 0)));
}

TEST(FindLooks, GivesAnEyeThatIsNotShownTheOther) {
  const PictureLayer layer = DrawnEye({80, 80}, {{84, 80}, 17});
  const std::array shown = {EyeAt({0, 0, 0}), EyeAt({6, 0, 0})};
  const std::vector<EyeLook> looks = FindLooks(shown, EyeCamera(), layer, kPaleSkin);
  ASSERT_TRUE(looks[0].disc);
  EXPECT_NEAR(looks[0].border, 17 / 48.0, 0.05);
  EXPECT_FALSE(looks[1].disc);
  EXPECT_EQ(looks[1].border, looks[0].border);
  EXPECT_TRUE(looks[1].profile->At(0.5F).isApprox(Eigen::Vector3f(0.1F, 0.2F, 0.5F), 0.05F));
}

TEST(EyesWithin, KeepsEyesOfTheOpenings) {
  render::Image mask(20, 20, 1, uint8_t(PictureClass::kSkin));
  for (int row = 4; row < 16; ++row)
    for (int column = 4; column < 16; ++column) mask.at(row, column) = uint8_t(PictureClass::kEyes);
  PicturePoints opening(4, 2);
  opening << 2, 10, 10, 8, 18, 10, 10, 12;  // A rhombus.
  const render::Image eyes = EyesWithin(mask, std::array{opening});
  EXPECT_EQ(eyes.at(10, 10), uint8_t(PictureClass::kEyes));
  EXPECT_EQ(eyes.at(5, 10), uint8_t(PictureClass::kBackground)) << "above the lid";
  EXPECT_EQ(eyes.at(10, 3), uint8_t(PictureClass::kBackground)) << "skin in the opening";
}

TEST(EyesWithin, TakesAllOfAnOpeningThatTheMaskMisses) {
  render::Image mask(20, 20, 1, uint8_t(PictureClass::kSkin));
  mask.at(10, 12) = uint8_t(PictureClass::kHair);
  PicturePoints opening(4, 2);
  opening << 2, 10, 10, 8, 18, 10, 10, 12;
  const render::Image eyes = EyesWithin(mask, std::array{opening});
  EXPECT_EQ(eyes.at(10, 10), uint8_t(PictureClass::kEyes));
  EXPECT_EQ(eyes.at(10, 12), uint8_t(PictureClass::kBackground)) << "hair";
}

TEST_F(PaintedEye, RefusesAnEyeOfFewerPoints) {
  ShownEye eye = EyeAt({0, 0, 0});
  eye.points.conservativeResize(3, 3);
  testing::ExpectError(
      [&] {
        PaintEye(chart_, eye, EyeCamera(), DrawnEye({80, 80}, {{80, 80}, 15}), {}, 1);
      },
      "3 points");
}

}  // namespace
}  // namespace daumier::fitting
