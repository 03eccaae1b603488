#include "render/camera.h"

#include "core/error.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>

namespace daumier::render {
namespace {

geometry::Points One(double x, double y, double z) {
  geometry::Points points(1, 3);
  points << x, y, z;
  return points;
}

void ExpectPixel(const Camera& camera, const geometry::Points& point, double x, double y, double depth) {
  const geometry::Points projected = Project(camera, point);
  EXPECT_NEAR(projected(0, 0), x, 1e-9);
  EXPECT_NEAR(projected(0, 1), y, 1e-9);
  EXPECT_NEAR(projected(0, 2), depth, 1e-9);
}

TEST(FrontalCamera, PutsTheFacesLeftOnTheRightAndUpOnTop) {
  // 10 cm from the centre to the top in 100 pixels: 5 pixels a cm.
  const Camera camera = FrontalCamera({1, 2, 3}, 10.0, 100);
  ExpectPixel(camera, One(1, 2, 3), 50, 50, 0);
  ExpectPixel(camera, One(3, 2, 3), 60, 50, 0);
  ExpectPixel(camera, One(1, 12, 3), 50, 0, 0);
  ExpectPixel(camera, One(1, 2, 7), 50, 50, -4);
}

TEST(SideCamera, LooksAtTheRightProfileWithTheNoseToTheRight) {
  const Camera camera = SideCamera({1, 2, 3}, 10.0, 100);
  ExpectPixel(camera, One(1, 2, 5), 60, 50, 0);
  ExpectPixel(camera, One(1, 4, 3), 50, 40, 0);
  ExpectPixel(camera, One(4, 2, 3), 50, 50, 3);
}

TEST(TurnedCamera, MovesLeftByYawAndUpByPitch) {
  const Camera left = TurnedCamera(Eigen::Vector3d::Zero(), 1.0, 2, 90.0);
  ExpectPixel(left, One(1, 0, 0), 1, 1, -1);
  ExpectPixel(left, One(0, 0, 1), 0, 1, 0);
  const Camera top = TurnedCamera(Eigen::Vector3d::Zero(), 1.0, 2, 0.0, 90.0);
  ExpectPixel(top, One(0, 1, 0), 1, 1, -1);
  ExpectPixel(top, One(0, 0, 1), 1, 2, 0);
  ExpectPixel(top, One(1, 0, 0), 2, 1, 0);
}

TEST(TurnedCamera, IsARotation) {
  for (const double yaw : {-90.0, 0.0, 33.0}) {
    for (const double pitch : {-20.0, 0.0, 50.0}) {
      const Eigen::Matrix3d rotation = TurnedCamera({1, 2, 3}, 4.0, 5, yaw, pitch).camera_from_world;
      EXPECT_LT((rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
      EXPECT_NEAR(rotation.determinant(), 1.0, 1e-12);
    }
  }
}

TEST(WithPerspective, KeepsWhatIsAtTheCentresDepthAndShrinksWhatIsBehind) {
  const Camera camera = WithPerspective(FrontalCamera({0, 0, 0}, 10.0, 100), 40.0);
  ExpectPixel(camera, One(3, -2, 0), 65, 60, 40);
  ExpectPixel(camera, One(3, -2, -40), 57.5, 55, 80);
  EXPECT_THROW(WithPerspective(camera, 40.0), Error);
  EXPECT_THROW(WithPerspective(FrontalCamera({0, 0, 0}, 1, 1), 0.0), Error);
}

TEST(Enlarged, ScalesPixelPositions) {
  for (const Camera& camera :
       {FrontalCamera({0, 1, 0}, 8.0, 64), WithPerspective(SideCamera({0, 1, 0}, 8.0, 64), 50.0)}) {
    const Camera large = Enlarged(camera, 3);
    EXPECT_EQ(large.width, 192);
    EXPECT_EQ(large.height, 192);
    const geometry::Points before = Project(camera, One(1, 2, 3)), after = Project(large, One(1, 2, 3));
    EXPECT_NEAR(after(0, 0), 3 * before(0, 0), 1e-9);
    EXPECT_NEAR(after(0, 1), 3 * before(0, 1), 1e-9);
    EXPECT_NEAR(after(0, 2), before(0, 2), 1e-12);
  }
  EXPECT_THROW(Enlarged(Camera{}, 0), Error);
}

TEST(FrameOf, HoldsAllPointsFromEveryAxis) {
  geometry::Points points(3, 3);
  points << -1, 0, 2, 3, 1, 2, 0, 10, 4;
  const Frame frame = FrameOf(points, 1.2);
  EXPECT_EQ(frame.centre, Eigen::Vector3d(1, 5, 3));
  EXPECT_DOUBLE_EQ(frame.half_height, 6.0);
  EXPECT_THROW(FrameOf(geometry::Points(0, 3)), Error);
  EXPECT_THROW(FrameOf(One(0, std::numeric_limits<double>::infinity(), 0)), Error);
}

TEST(FrontalCamera, RefusesSizesThatAreNotPositive) {
  EXPECT_THROW(FrontalCamera({0, 0, 0}, 0.0, 10), Error);
  EXPECT_THROW(FrontalCamera({0, 0, 0}, 1.0, 0), Error);
}

}  // namespace
}  // namespace daumier::render
