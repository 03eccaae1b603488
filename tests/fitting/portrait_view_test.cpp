#include "fitting/portrait_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace daumier::fitting {
namespace {

TEST(PortraitView, PutsUpOnTopAndTheFacesLeftOnTheRight) {
  geometry::Points points(3, 3);
  points << 0, 0, 0, 1, 0, 0, 0, 2, 0;
  const PicturePoints pixels = Projected(points);
  EXPECT_TRUE(pixels.row(0).isApprox(Eigen::RowVector2d(112, 112)));
  EXPECT_TRUE(pixels.row(1).isApprox(Eigen::RowVector2d(112 + 10.15, 112)));
  EXPECT_TRUE(pixels.row(2).isApprox(Eigen::RowVector2d(112, 112 - 20.3)));
}

TEST(PortraitView, RotatesAboutXThenYThenZ) {
  PortraitPose pose = PortraitPose::Zero();
  pose[1] = std::acos(0.0);  // A quarter turn of yaw sends z to x.
  EXPECT_TRUE((RotationOf(pose) * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitX()));
  pose[0] = pose[1];  // Pitch first: z to -y, which yaw does not move.
  EXPECT_TRUE((RotationOf(pose) * Eigen::Vector3d::UnitZ()).isApprox(-Eigen::Vector3d::UnitY()));
  pose[2] = pose[0];  // Then roll: -y to x.
  EXPECT_TRUE((RotationOf(pose) * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitX()));
}

TEST(PortraitView, ThePoseOfARotationHasIt) {
  PortraitPose pose = PortraitPose::Zero();
  pose.head<3>() << 0.3, -0.7, 1.9;
  EXPECT_TRUE(PoseOfRotation(RotationOf(pose)).isApprox(pose));
}

TEST(PortraitView, AngleBetweenPosesIsThatOfTheirRotation) {
  PortraitPose a = PortraitPose::Zero(), b = a;
  b[1] = 0.2;
  EXPECT_NEAR(AngleBetween(a, b), 0.2 * 180 / std::acos(-1.0), 1e-9);
  EXPECT_NEAR(AngleBetween(b, b), 0, 1e-5);
}

TEST(PortraitView, OfAnotherCameraHasItsOwnFocalLengthCentreAndDistance) {
  geometry::Points points(1, 3);
  points << 2, -1, 10;
  // 40 cm away: 500 / 40 pixels a cm.
  EXPECT_TRUE(Projected(points, {.focal = 500, .centre = 64, .distance = 50})
                  .row(0)
                  .isApprox(Eigen::RowVector2d(64 + 25, 64 + 12.5)));
}

TEST(PortraitView, PosesByTurningAndThenShifting) {
  geometry::Points points(2, 3);
  points << 0, 0, 2, 0, 3, 0;
  PortraitPose pose;
  pose << 0, std::numbers::pi / 2, 0, 10, 20, 30;  // Yaw: z to x.
  geometry::Points expected(2, 3);
  expected << 12, 20, 30, 10, 23, 30;
  EXPECT_TRUE(Posed(points, pose).isApprox(expected));
}

TEST(PortraitView, AngleBetweenPosesIgnoresTheirPlaces) {
  PortraitPose a, b;
  a << 0.1, -0.4, 0.3, 0, 0, 0;
  b << 0.1, -0.4, 0.3, 5, -6, -40;
  EXPECT_NEAR(AngleBetween(a, b), 0, 1e-5);
  b << 0, std::numbers::pi, 0, 0, 0, 0;  // The greatest angle.
  EXPECT_NEAR(AngleBetween(PortraitPose::Zero(), b), 180, 1e-5);
}

}  // namespace
}  // namespace daumier::fitting
