#include "rig/eye_clearance.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::rig {
namespace {

const faces::Eyeball kBall{{0, 0, 0}, {2, 2, 2}, 0.8, 0};
const faces::Eyeball kCornea{{1, 2, 3}, {2, 2, 2}, 0.8, 0.2};

/// A sheet of squares at a height of z, from -1.5 to 1.5 in x and y, with a slit of four vertices around the origin.
geometry::TriangleMesh Sheet(double z) {
  constexpr int kSide = 13;
  geometry::TriangleMesh mesh;
  mesh.vertices.resize(kSide * kSide, 3);
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j) mesh.vertices.row(i * kSide + j) << 0.25 * (j - 6), 0.25 * (i - 6), z;
  mesh.triangles.resize(2 * (kSide - 1) * (kSide - 1), 3);
  int t = 0;
  for (int i = 0; i + 1 < kSide; ++i) {
    for (int j = 0; j + 1 < kSide; ++j) {
      const int v = i * kSide + j;
      mesh.triangles.row(t++) << v, v + 1, v + kSide + 1;
      mesh.triangles.row(t++) << v, v + kSide + 1, v + kSide;
    }
  }
  return mesh;
}
const std::vector<int> kLids = {83, 85, 86, 84};  // Its middle row, x from -0.25 to 0.5.
const SeamEdges kEdges = {{83, 84, 85, 86}, {83, 84, 85, 86}};

TEST(EyeClearance, IsTheDistanceFromASphere) {
  const Eigen::Vector3d front = Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(EyeClearance(kBall, front, {3, 0, 0}), 1, 1e-12);
  EXPECT_NEAR(EyeClearance(kBall, front, {0, 0.5, 0}), -1.5, 1e-12);
  EXPECT_NEAR(EyeClearance(kBall, GazeOf(20, 10), {3, 0, 0}), 1, 1e-12) << "a sphere looks alike everywhere";
}

TEST(SetBack, MakesASphereBehindWithALowerCornea) {
  const faces::Eyeball shipped = SetBack({{1, 2, 3}, {2, 2.5, 2}, 0.8, 0.2});
  EXPECT_EQ(shipped.centre, Eigen::Vector3d(1, 2, 2.95));
  EXPECT_EQ(shipped.radii, Eigen::Vector3d(2, 2, 2));
  EXPECT_NEAR(shipped.bulge, 0.07, 1e-12);
  EXPECT_EQ(shipped.iris_radius, 0.8);
}

TEST(EyeClearance, CountsTheCorneaWhereTheEyeLooks) {
  EXPECT_NEAR(EyeClearance(kCornea, Eigen::Vector3d::UnitZ(), {1, 2, 5.5}), 0.3, 1e-12);
  const Eigen::Vector3d down = GazeOf(0, 30);
  EXPECT_NEAR(EyeClearance(kCornea, down, {1, 2, 5.5}), 0.5, 1e-12) << "the cornea is elsewhere";
  EXPECT_NEAR(EyeClearance(kCornea, down, kCornea.centre + 2.5 * down), 0.3, 1e-9);
}

TEST(EyeClearance, GazeTurnsLeftAndDown) {
  EXPECT_TRUE(GazeOf(0, 0).isApprox(Eigen::Vector3d::UnitZ()));
  EXPECT_NEAR(GazeOf(30, 0).x(), 0.5, 1e-12);
  EXPECT_NEAR(GazeOf(0, 30).y(), -0.5, 1e-12);
  EXPECT_NEAR(GazeOf(25, -40).norm(), 1, 1e-12);
}

TEST(EyeSkin, LeastClearanceIsThatOfTheMiddleOfAFlatSheet) {
  const geometry::TriangleMesh sheet = Sheet(2.5);
  const EyeSkin skin(sheet, kLids, kEdges);
  EXPECT_NEAR(skin.LeastClearance(kBall, Eigen::Vector3d::UnitZ(), sheet.vertices), 0.5, 1e-12);
}

TEST(EyeSkin, KeepOutsideHoldsOnTheWholeWay) {
  const geometry::TriangleMesh sheet = Sheet(2.1);
  const EyeSkin skin(sheet, kLids, kEdges);
  geometry::Points pose = sheet.vertices;
  pose.col(2).array() -= 0.5;  // Into the ball.
  skin.KeepOutside(kBall, {}, sheet.vertices, pose);
  for (const double time : {0.25, 0.5, 0.75, 1.0}) {
    const geometry::Points between = (1 - time) * sheet.vertices + time * pose;
    EXPECT_GT(skin.LeastClearance(kBall, Eigen::Vector3d::UnitZ(), between), 0) << time;
  }
}

TEST(EyeSkin, KeepOutsideMovesNothingThatIsOutside) {
  const geometry::TriangleMesh sheet = Sheet(2.5);
  geometry::Points pose = sheet.vertices;
  pose.col(1).array() += 0.1;
  const geometry::Points before = pose;
  EyeSkin(sheet, kLids, kEdges).KeepOutside(kBall, {30, 0}, sheet.vertices, pose);
  EXPECT_EQ(pose, before);
}

TEST(EyeSkin, LeavesOutWhatIsBehindTheEdges) {
  const geometry::TriangleMesh sheet = Sheet(2.5);
  geometry::Points pose = sheet.vertices;
  pose(84, 2) = 0;  // In the middle of the ball.
  const SeamEdges around = {{83, 96, 97, 98, 99, 86}, {83, 70, 71, 72, 73, 86}};
  const Eigen::Vector3d front = Eigen::Vector3d::UnitZ();
  EXPECT_GT(EyeSkin(sheet, {84, 85, 84, 85}, around).LeastClearance(kBall, front, pose), 0.4);
  EXPECT_LT(EyeSkin(sheet, kLids, kEdges).LeastClearance(kBall, front, pose), -1);
}

TEST(EyeSkin, GreatestMoveIsOfItsVerticesAlone) {
  const geometry::TriangleMesh sheet = Sheet(2);
  Eigen::VectorXf offset = Eigen::VectorXf::Zero(3 * sheet.vertices.rows());
  offset.segment<3>(0) << 0, 9, 0;  // A corner of the sheet, 2.1 from the lids of width 0.75.
  offset.segment<3>(3 * kLids[0]) << 0.3f, 0, 0.4f;
  EXPECT_FLOAT_EQ(float(EyeSkin(sheet, kLids, kEdges).GreatestMove(offset)), 0.5f);
}

TEST(EyeSkin, NeedsLids) {
  testing::ExpectError([] { EyeSkin(Sheet(2), {}, kEdges); }, "an eye without lids");
}

}  // namespace
}  // namespace daumier::rig
