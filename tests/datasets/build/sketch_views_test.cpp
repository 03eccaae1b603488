#include "datasets/build/sketch_views.h"

#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::datasets {
namespace {

TEST(SketchCamera, MeanHeadIsCentred) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  for (const faces::View view : {faces::View::kFrontal, faces::View::kSide}) {
    const geometry::Points pixels = render::Project(SketchCamera(face, view, 0.62), face.neutral);
    double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
    for (const faces::FeatureCurve& curve : face.annotation.curves) {
      if (curve.view != view) continue;
      for (const int vertex : curve.vertices) {
        left = std::min(left, pixels(vertex, 0)), right = std::max(right, pixels(vertex, 0));
        top = std::min(top, pixels(vertex, 1)), bottom = std::max(bottom, pixels(vertex, 1));
      }
    }
    EXPECT_NEAR(bottom - top, 0.62 * 256, 1e-9);
    EXPECT_NEAR((top + bottom) / 2, 128, 1e-9);
    EXPECT_NEAR((left + right) / 2, 128, 1e-9);
  }
}

TEST(SketchCamera, AViewWithoutCurvesIsRefused) {
  faces::FaceTemplate face = testing::SyntheticFace();
  std::erase_if(face.annotation.curves, [](const auto& curve) { return curve.view == faces::View::kSide; });
  testing::ExpectError([&] { SketchCamera(face, faces::View::kSide, 0.6); }, "no side-view curve");
  face.annotation.curves.clear();
  testing::ExpectError([&] { SketchCamera(face, faces::View::kFrontal, 0.6); }, "no frontal curve");
}

constexpr ViewNoise kStill = {.yaw = 0, .pitch = 0, .roll = 0, .scale = 0, .shift = 0};
const render::Camera kCamera = render::FrontalCamera({1, 2, 3}, 10, 256);

TEST(NoisyCamera, WithoutNoiseIsTheCameraItself) {
  Rng rng(1);
  const render::Camera camera = NoisyCamera(kCamera, kStill, rng);
  EXPECT_TRUE(camera.camera_from_world.isApprox(kCamera.camera_from_world, 1e-15));
  EXPECT_TRUE(camera.translation.isApprox(kCamera.translation, 1e-15));
  EXPECT_EQ(camera.scale, kCamera.scale);
  EXPECT_EQ(camera.principal_point, kCamera.principal_point);
}

TEST(NoisyCamera, TurnsAboutTheMiddleByAtMostTwiceTheDeviation) {
  ViewNoise noise = kStill;
  noise.yaw = 5;
  Rng rng(2);
  const geometry::Points centre = (geometry::Points(1, 3) << 1, 2, 3).finished();
  double sum_of_squares = 0, largest = 0;
  constexpr int kDraws = 2000;
  for (int i = 0; i < kDraws; ++i) {
    const render::Camera camera = NoisyCamera(kCamera, noise, rng);
    EXPECT_LT((render::Project(camera, centre) - render::Project(kCamera, centre)).norm(), 1e-9);
    const Eigen::Matrix3d turn = camera.camera_from_world * kCamera.camera_from_world.transpose();
    const double degrees = Eigen::AngleAxisd(turn).angle() * 180 / std::numbers::pi;
    sum_of_squares += degrees * degrees;
    largest = std::max(largest, degrees);
  }
  EXPECT_LE(largest, 10 + 1e-6);
  EXPECT_GT(largest, 9.9) << "cut off, and reached in this number of draws";
  EXPECT_NEAR(std::sqrt(sum_of_squares / kDraws), 5 * 0.96, 0.2) << "the deviation of what is clamped at two";
}

TEST(NoisyCamera, ScaleAndShiftMoveThePicture) {
  ViewNoise noise = kStill;
  noise.scale = 0.1;
  noise.shift = 3;
  Rng rng(4);
  const render::Camera camera = NoisyCamera(kCamera, noise, rng);
  EXPECT_NE(camera.scale, kCamera.scale);
  EXPECT_LE(std::abs(camera.scale / kCamera.scale - 1), 0.2);
  EXPECT_LE((camera.principal_point - kCamera.principal_point).cwiseAbs().maxCoeff(), 6);
  EXPECT_GT((camera.principal_point - kCamera.principal_point).cwiseAbs().minCoeff(), 0);
}

TEST(TurnedViewCamera, TurnsToBothSidesWithinItsLimits) {
  Rng rng(3);
  int num_left = 0;
  for (int i = 0; i < 200; ++i) {
    const render::Camera camera = TurnedViewCamera(kCamera, {.count = 1, .least = 20, .greatest = 50}, kStill, rng);
    const Eigen::Vector3d forward = camera.camera_from_world.col(2);
    const double yaw = std::atan2(forward.x(), -forward.z()) * 180 / std::numbers::pi;
    EXPECT_GE(std::abs(yaw), 20 - 1e-9);
    EXPECT_LE(std::abs(yaw), 50 + 1e-9);
    EXPECT_NEAR(forward.y(), 0, 1e-12);
    num_left += yaw < 0 ? 1 : 0;
  }
  EXPECT_GT(num_left, 60);
  EXPECT_LT(num_left, 140);
  testing::ExpectError([&] { TurnedViewCamera(kCamera, {.count = 1, .least = 50, .greatest = 20}, kStill, rng); },
                       "turned.least is 50");
}

}  // namespace
}  // namespace daumier::datasets
