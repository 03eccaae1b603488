#include "raster/rigid_pose.h"

#include "tests/raster/small_mesh.h"

#include <gtest/gtest.h>

namespace daumier::raster {
namespace {

std::vector<double> PosedBy(const std::vector<double>& pose, const std::vector<double>& points) {
  Pose<double> of;
  std::copy_n(pose.begin(), 6, of.begin());
  std::vector<double> posed(points.size());
  ApplyPose(of, points.size() / 3, points.data(), posed.data());
  return posed;
}

void ExpectPoint(const std::vector<double>& point, double x, double y, double z) {
  EXPECT_NEAR(point[0], x, 1e-12);
  EXPECT_NEAR(point[1], y, 1e-12);
  EXPECT_NEAR(point[2], z, 1e-12);
}

TEST(ApplyPose, TurnsByPitchThenYawThenRoll) {
  const double quarter = std::numbers::pi / 2;
  ExpectPoint(PosedBy({quarter, 0, 0, 0, 0, 0}, {0, 1, 0}), 0, 0, 1);              // About x: y becomes z.
  ExpectPoint(PosedBy({0, quarter, 0, 0, 0, 0}, {0, 0, 1}), 1, 0, 0);              // About y: z becomes x.
  ExpectPoint(PosedBy({0, 0, quarter, 0, 0, 0}, {1, 0, 0}), 0, 1, 0);              // About z: x becomes y.
  ExpectPoint(PosedBy({quarter, quarter, quarter, 1, 2, 3}, {0, 1, 0}), 1, 3, 3);  // y -> z -> x -> y
}

TEST(ApplyPose, InPlaceIsTheSame) {
  const auto points = RandomNumbers<double>(12, 3), pose = RandomNumbers<double>(6, 4);
  Pose<double> of;
  std::copy_n(pose.begin(), 6, of.begin());
  auto moved = points;
  ApplyPose(of, 4, moved.data(), moved.data());
  EXPECT_EQ(moved, PosedBy(pose, points));
}

TEST(ApplyPose, GradientsEqualCentralDifferences) {
  const auto points = RandomNumbers<double>(12, 3), pose = RandomNumbers<double>(6, 4);
  const auto weights = RandomNumbers<double>(12, 5);
  Pose<double> of, by_pose = {};
  std::copy_n(pose.begin(), 6, of.begin());
  std::vector<double> by_points(12);
  ApplyPoseBackward(of, 4, points.data(), weights.data(), by_pose, by_points.data());
  EXPECT_LT(MaxDifference([&](const auto& x) { return Dot(weights, PosedBy(x, points)); }, pose,
                          {by_pose.begin(), by_pose.end()}),
            1e-8);
  EXPECT_LT(MaxDifference([&](const auto& x) { return Dot(weights, PosedBy(pose, x)); }, points, by_points), 1e-8);
}

}  // namespace
}  // namespace daumier::raster
