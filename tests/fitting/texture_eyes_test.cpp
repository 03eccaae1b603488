#include "fitting/texture_eyes.h"

#include "faces/eyeball.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <algorithm>
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

ShownEye EyeAt(const geometry::Vector3& centre) {
  return {centre, Eigen::Matrix3d::Identity(),
          faces::EyeballPoints({.centre = {0, 0, 0}, .radii = {1.2, 1.2, 1.2}, .iris_radius = 0.45, .bulge = 0})};
}

constexpr int kSide = 160;

/// A picture of an eye: an almond of grey white with a dark iris of blue; what lies above `lid` is of another class.
PictureLayer DrawnEye(const Eigen::Vector2d& middle, const IrisDisc& iris, double lid = 0) {
  PictureLayer layer{kSide, kSide, std::vector<float>(3 * kSide * kSide, 0.5F), std::vector<float>(kSide * kSide, 0.0F),
                     0};
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) {
      const double x = column + 0.5, y = row + 0.5;
      if (std::hypot((x - middle.x()) / 40, (y - middle.y()) / 24) > 1 || y < lid) continue;
      const size_t pixel = size_t(row) * kSide + size_t(column);
      const bool is_iris = std::hypot(x - iris.centre.x(), y - iris.centre.y()) < iris.radius;
      const Eigen::Vector3f colour = is_iris ? Eigen::Vector3f(0.1F, 0.2F, 0.5F) : Eigen::Vector3f(0.8F, 0.8F, 0.8F);
      std::copy_n(colour.data(), 3, layer.colours.begin() + ptrdiff_t(3 * pixel));
      layer.confidence[pixel] = 1;
      ++layer.num_known;
    }
  }
  return layer;
}

/// 40 pixels a cm at the origin's depth, which is the picture's middle.
PictureCamera EyeCamera() {
  PictureCamera camera;
  camera.linear *= 40 / 10.15;
  camera.shift = Eigen::Vector2d::Constant(kSide / 2 - 112 * 40 / 10.15);
  return camera;
}

TEST(FindIris, FindsTheDarkDisc) {
  const IrisDisc iris{{88, 76}, 14};
  const auto found = FindIris(DrawnEye({80, 80}, iris), {80, 80}, 60);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->centre.x(), 88, 2);
  EXPECT_NEAR(found->centre.y(), 76, 2);
  EXPECT_NEAR(found->radius, 14, 2.5);
}

TEST(FindIris, FindsItWhereALidHidesItsUpperPart) {
  const auto found = FindIris(DrawnEye({80, 80}, {{74, 80}, 15}, 76), {80, 80}, 60);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->centre.x(), 74, 2);
  EXPECT_NEAR(found->centre.y(), 80, 4);
}

TEST(FindIris, FindsNoneInAClosedOrAnEvenEye) {
  EXPECT_FALSE(FindIris(DrawnEye({80, 80}, {{80, 80}, 14}, 103), {80, 80}, 60)) << "closed but for a line";
  EXPECT_FALSE(FindIris(DrawnEye({80, 80}, {{300, 300}, 1}), {80, 80}, 60)) << "white alone";
  EXPECT_FALSE(FindIris(DrawnEye({80, 80}, {{80, 80}, 14}), {10, 10}, 20)) << "elsewhere";
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
  const auto colours = PaintEye(chart_, EyeAt({0, 0, 0}), EyeCamera(), DrawnEye({80, 80}, {{94, 80}, 14}), 1);
  EXPECT_NEAR(At(colours, 0, 0)[2], 0.5, 0.05);
  EXPECT_NEAR(At(colours, 0.1, 0.1)[0], 0.1, 0.05);
  EXPECT_NEAR(At(colours, -0.6, 0)[0], 0.8, 0.05) << "seen white";
  EXPECT_GT(At(colours, 0, 0.95)[0], 0.8) << "white where unseen";
}

TEST_F(PaintedEye, CompletesAnIrisThatALidHides) {
  const auto colours = PaintEye(chart_, EyeAt({0, 0, 0}), EyeCamera(), DrawnEye({80, 80}, {{80, 80}, 15}, 78), 1);
  EXPECT_NEAR(At(colours, 0, 0.18)[2], 0.5, 0.06);
  EXPECT_NEAR(At(colours, 0, 0.18)[0], 0.1, 0.06);
}

TEST_F(PaintedEye, IsPlainWhereThePictureShowsNone) {
  const auto colours = PaintEye(chart_, EyeAt({0, 0, 0}), EyeCamera(), DrawnEye({80, 80}, {{80, 80}, 15}, 200), 1);
  EXPECT_LT(At(colours, 0, 0).maxCoeff(), 0.1) << "pupil";
  EXPECT_NEAR(At(colours, 0.25, 0)[0], 0.36, 0.03) << "iris";
  EXPECT_GT(At(colours, 0.7, 0).minCoeff(), 0.9) << "white";
}

TEST_F(PaintedEye, IsDividedByTheShade) {
  const PictureLayer layer = DrawnEye({80, 80}, {{80, 80}, 15});
  const auto plain = PaintEye(chart_, EyeAt({0, 0, 0}), EyeCamera(), layer, 1);
  const auto shaded = PaintEye(chart_, EyeAt({0, 0, 0}), EyeCamera(), layer, 0.8F);
  EXPECT_TRUE(At(shaded, 0, 0).isApprox(At(plain, 0, 0) / 0.8F, 1e-3F));
}

TEST_F(PaintedEye, RefusesAnEyeOfFewerPoints) {
  ShownEye eye = EyeAt({0, 0, 0});
  eye.points.conservativeResize(3, 3);
  testing::ExpectError([&] { PaintEye(chart_, eye, EyeCamera(), DrawnEye({80, 80}, {{80, 80}, 15}), 1); }, "3 points");
}

}  // namespace
}  // namespace daumier::fitting
