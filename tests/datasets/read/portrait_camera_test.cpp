#include "datasets/read/portrait_camera.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

namespace daumier::datasets {
namespace {

geometry::Points OnePoint(double x, double y, double z) {
  geometry::Points point(1, 3);
  point << x, y, z;
  return point;
}

TEST(PortraitCamera, ProjectsByTheFormula) {
  const std::vector<float> pose = {0, 0, 0, 1, 2, -10};
  const geometry::Points pixel = render::Project(PortraitCamera({}, pose), OnePoint(3, 4, 5));
  // q = (4, 6, -5), 105 cm away.
  EXPECT_NEAR(pixel(0, 0), 112 + 1015 * 4.0 / 105, 1e-9);
  EXPECT_NEAR(pixel(0, 1), 112 - 1015 * 6.0 / 105, 1e-9);
  EXPECT_NEAR(pixel(0, 2), 105, 1e-9);
}

TEST(PortraitCamera, TurnsByPitchThenYawThenRoll) {
  constexpr auto kQuarter = static_cast<float>(std::numbers::pi / 2);
  // Pitch takes y to z, yaw takes z to x, roll takes x to y.
  const std::vector<float> pose = {kQuarter, kQuarter, kQuarter, 0, 0, 0};
  const Eigen::Vector3d turned = PoseRotation(pose) * Eigen::Vector3d::UnitY();
  EXPECT_LT((turned - Eigen::Vector3d::UnitY()).norm(), 1e-6);
  const std::vector<float> yaw = {0, kQuarter, 0, 0, 0, 0};
  EXPECT_LT((PoseRotation(yaw) * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitX()).norm(), 1e-6);
}

TEST(PortraitCamera, OtherNumbersAreRefused) {
  testing::ExpectError([] { PortraitCamera({}, std::vector<float>(5)); }, "a pose of 5 numbers");
}

}  // namespace
}  // namespace daumier::datasets
