#include "rig/mouth_shapes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace daumier::rig {
namespace {

double VolumeOf(const Tube& tube, const std::vector<double>& columns, const geometry::Points& points) {
  double volume = 0;
  const ChartPiece piece = TubeChart(tube, columns, 1, TextureChart::kTeeth, 0, 1);
  for (const auto& t : piece.triangles.rowwise()) {
    const geometry::Vector3 a = points.row(t[0]), b = points.row(t[1]), c = points.row(t[2]);
    volume += a.dot(b.cross(c)) / 6;
  }
  return volume;
}

TEST(MouthShapes, FaceOutwards) {
  EXPECT_GT(VolumeOf(kTeethTube, TeethColumns(), TeethPoints(Jaw::kUpper)), 0.01);
  EXPECT_GT(VolumeOf(kTeethTube, TeethColumns(), TeethPoints(Jaw::kLower)), 0.01);
  EXPECT_GT(VolumeOf(kTongueTube, TongueColumns(), TongueAtRest()), 0.01);
  EXPECT_GT(VolumeOf(kTongueTube, TongueColumns(), TongueOut(0.2)), 0.005);
}

TEST(MouthShapes, TeethAreSymmetricAndMeetAtTheLips) {
  for (const Jaw jaw : {Jaw::kUpper, Jaw::kLower}) {
    const geometry::Points points = TeethPoints(jaw);
    for (int column = 0; column < kTeethTube.num_columns; ++column)
      for (int side = 0; side < kTeethTube.num_sides; ++side) {
        const auto a = points.row(kTeethTube.vertex(column, side)),
                   b = points.row(kTeethTube.vertex(kTeethTube.num_columns - 1 - column, side));
        EXPECT_NEAR(a.x(), -b.x(), 1e-12);
        EXPECT_NEAR(a.y(), b.y(), 1e-12);
        EXPECT_NEAR(a.z(), b.z(), 1e-12);
      }
  }
  const geometry::Points upper = TeethPoints(Jaw::kUpper), lower = TeethPoints(Jaw::kLower);
  EXPECT_NEAR(Eigen::VectorXd(upper.col(1)).minCoeff(), -0.065, 1e-4);
  EXPECT_NEAR(Eigen::VectorXd(lower.col(1)).maxCoeff(), -0.045, 1e-4);
  EXPECT_GT(Eigen::VectorXd(upper.col(2)).maxCoeff(), Eigen::VectorXd(lower.col(2)).maxCoeff() + 0.03);
}

TEST(MouthShapes, ArchDepthIsTheFrontOfTheTeeth) {
  for (const Jaw jaw : {Jaw::kUpper, Jaw::kLower}) {
    const geometry::Points points = TeethPoints(jaw);
    for (const auto& p : points.rowwise())
      if (IsInArch(jaw, p.x())) {
        EXPECT_LT(p.z(), ArchDepth(jaw, p.x()) + 0.05) << "the gum is thicker than the teeth";
      }
    EXPECT_FALSE(IsInArch(jaw, 0.5));
    EXPECT_LT(ArchDepth(jaw, 0.3), ArchDepth(jaw, 0.0));
  }
  EXPECT_EQ(ArchDepth(Jaw::kUpper, 0), 0);
}

TEST(MouthShapes, TeethAreWhiteBetweenGums) {
  const auto materials = TeethMaterials();
  ASSERT_EQ(int(materials.size()), kTeethTube.num_triangles());
  const auto num_white = std::count(materials.begin(), materials.end(), faces::HeadMaterial::kTooth);
  EXPECT_EQ(2 * num_white, long(materials.size())) << "four of eight sides";
  EXPECT_EQ(std::count(materials.begin(), materials.end(), faces::HeadMaterial::kGum), num_white);
}

TEST(MouthShapes, ATongueReachesOverTheLipAndKeepsItsRoot) {
  const geometry::Points rest = TongueAtRest();
  for (const double lip : {0.05, 0.2, 0.4}) {
    const geometry::Points out = TongueOut(lip);
    EXPECT_GT(Eigen::VectorXd(out.col(2)).maxCoeff(), lip + 0.2);
    for (int side = 0; side < kTongueTube.num_sides; ++side)
      EXPECT_LT((out.row(kTongueTube.vertex(0, side)) - rest.row(kTongueTube.vertex(0, side))).norm(), 0.12);
    // Above the lip's line where it passes the lip, below it at the tip.
    for (const auto& p : out.rowwise())
      if (std::abs(p.z() - lip) < 0.03 && std::abs(p.x()) < 0.01) {
        EXPECT_GT(p.y(), -0.09);
      }
    EXPECT_LT(Eigen::VectorXd(out.col(1)).minCoeff(), -0.2);
  }
  EXPECT_LT(Eigen::VectorXd(rest.col(2)).maxCoeff(), -0.05) << "behind the lower teeth";
}

}  // namespace
}  // namespace daumier::rig
