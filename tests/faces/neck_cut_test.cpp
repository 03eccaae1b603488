#include "faces/neck_cut.h"

#include "geometry/topology.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace daumier::faces {
namespace {

constexpr int kAround = 40, kHigh = 6;

/// A tube around y of radius 5, closed above, whose lower border is a zigzag on a tilted plane.
geometry::TriangleMesh RaggedTube(double zigzag) {
  geometry::TriangleMesh mesh;
  mesh.vertices.resize(kAround * kHigh + 1, 3);
  for (int j = 0; j < kHigh; ++j) {
    for (int i = 0; i < kAround; ++i) {
      const double angle = 2 * std::numbers::pi * i / kAround;
      const double border = j == 0 && i % 2 == 1 ? zigzag : 0;
      mesh.vertices.row(j * kAround + i) << 5 * std::sin(angle), j + border + 0.3 * 5 * std::cos(angle),
          5 * std::cos(angle);
    }
  }
  mesh.vertices.row(kAround * kHigh) << 0, kHigh, 0;
  std::vector<Eigen::Vector3i> triangles;
  for (int i = 0; i < kAround; ++i) {
    const int next = (i + 1) % kAround;
    for (int j = 0; j + 1 < kHigh; ++j) {
      triangles.emplace_back(j * kAround + i, j * kAround + next, (j + 1) * kAround + next);
      triangles.emplace_back(j * kAround + i, (j + 1) * kAround + next, (j + 1) * kAround + i);
    }
    triangles.emplace_back((kHigh - 1) * kAround + i, (kHigh - 1) * kAround + next, kAround * kHigh);
  }
  mesh.triangles.resize(Eigen::Index(triangles.size()), 3);
  for (size_t t = 0; t < triangles.size(); ++t) mesh.triangles.row(Eigen::Index(t)) = triangles[t].transpose();
  return mesh;
}

std::vector<int> BorderOf(const geometry::TriangleMesh& mesh) {
  return geometry::BoundaryLoops(mesh.triangles, int(mesh.vertices.rows())).at(0);
}

/// y - 0.3 z of a loop: its height over the tilted plane.
Eigen::VectorXd HeightsOf(const geometry::Points& loop) {
  return loop.col(1) - 0.3 * loop.col(2);
}

TEST(CutBorder, OfAZigzagIsASmoothLoop) {
  const geometry::TriangleMesh mesh = RaggedTube(0.5);
  const geometry::LevelCut cut = CutBorder(mesh, BorderOf(mesh), {});
  ASSERT_FALSE(cut.points.empty());
  const geometry::Points points = geometry::WithEdgePoints(mesh.vertices, cut.points);
  const auto loops = geometry::BoundaryLoops(cut.triangles, int(points.rows()));
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_GE(*std::min_element(loops[0].begin(), loops[0].end()), mesh.vertices.rows()) << "edge points alone";
  const Eigen::VectorXd heights = HeightsOf(LoopPoints(points, loops[0]));
  EXPECT_LT(heights.maxCoeff() - heights.minCoeff(), 0.05) << "the zigzag had 0.5";
  EXPECT_GT(heights.minCoeff(), 0.5) << "within the innermost vertex";
  EXPECT_LT(heights.maxCoeff(), 1.0);
}

TEST(CutBorder, LeavesAMeshWholeThatItWouldDamage) {
  const geometry::TriangleMesh mesh = RaggedTube(0.5);
  EXPECT_TRUE(CutBorder(mesh, BorderOf(mesh), {1}).points.empty()) << "a vertex of the border is kept";
  EXPECT_TRUE(CutBorder(mesh, {0, 1, 2}, {}).points.empty()) << "no loop to fit";
  const geometry::TriangleMesh deep = RaggedTube(40);
  EXPECT_EQ(CutBorder(deep, BorderOf(deep), {}).triangles, deep.triangles) << "too far from its fit";
}

geometry::Points CircleOfLoop(int n, double radius) {
  geometry::Points loop(n, 3);
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    loop.row(i) << radius * std::cos(angle), 0, radius * std::sin(angle);
  }
  return loop;
}

TEST(SmoothlyMoved, KeepsSmoothMotionsAndEvensOutRaggedOnes) {
  const geometry::Points neutral = CircleOfLoop(48, 5);
  EXPECT_EQ(SmoothlyMoved(neutral, neutral), neutral);
  const geometry::Points moved = neutral.rowwise() + Eigen::RowVector3d(1, 2, 3);
  EXPECT_LT((SmoothlyMoved(neutral, moved) - moved).cwiseAbs().maxCoeff(), 1e-12);
  geometry::Points ragged = neutral;
  for (int i = 0; i < 48; i += 2) ragged(i, 1) += 0.4;
  const Eigen::VectorXd heights = SmoothlyMoved(neutral, ragged).col(1);
  EXPECT_LT(heights.maxCoeff() - heights.minCoeff(), 1e-10) << "the highest frequency vanishes in one step";
  EXPECT_NEAR(heights.mean(), 0.2, 1e-12);
}

TEST(CapPoints, OfACircleLieWithinItAndOutside) {
  // Walked about +y, a surface above it is on its left, and the cap is below.
  geometry::Points loop = CircleOfLoop(32, 5);
  loop = loop.colwise().reverse().eval();
  const geometry::Points cap = CapPoints(loop);
  ASSERT_EQ(cap.rows(), kCapRings * 32 + 1);
  const double side = cap(0, 1) < 0 ? -1 : 1;
  for (const auto& row : cap.rowwise()) {
    EXPECT_GT(side * row.y(), 0.1);
    EXPECT_LT(side * row.y(), 0.4);
    EXPECT_LT(std::hypot(row.x(), row.z()), 5);
  }
  EXPECT_LT(cap.bottomRows(1).row(0).head<1>().norm(), 1e-12);
}

}  // namespace
}  // namespace daumier::faces
