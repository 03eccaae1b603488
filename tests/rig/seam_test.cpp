#include "rig/seam.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace daumier::rig {
namespace {

/// Two strips of skin on either side of a slit along x: rows of seven vertices at y = +-(h + row), h the height of a
/// lens between the corners, which both strips share. Rows 0 .. 3 up, then rows 1 .. 3 down with a lower edge of its own.
struct Slit {
  geometry::TriangleMesh mesh;
  SeamEdges edges;

  explicit Slit(double opening) {
    constexpr int kColumns = 7, kRows = 4;
    std::vector<Eigen::Vector3d> points;
    std::vector<std::vector<int>> up(kRows), down(kRows);
    for (int row = 0; row < kRows; ++row) {
      for (int i = 0; i < kColumns; ++i) {
        const double x = i - 3.0, lens = opening * (1 - x * x / 9);
        up[size_t(row)].push_back(static_cast<int>(points.size()));
        points.emplace_back(x, lens + row, 0);
        const bool is_corner = row == 0 && (i == 0 || i == kColumns - 1);
        down[size_t(row)].push_back(is_corner ? up[0].back() : static_cast<int>(points.size()));
        if (!is_corner) points.emplace_back(x, -lens - row, -0.1);
      }
    }
    std::vector<Eigen::Vector3i> triangles;
    for (int row = 0; row + 1 < kRows; ++row) {
      for (int i = 0; i + 1 < kColumns; ++i) {
        const auto r = size_t(row), c = size_t(i);
        triangles.emplace_back(up[r][c], up[r][c + 1], up[r + 1][c + 1]);
        triangles.emplace_back(up[r][c], up[r + 1][c + 1], up[r + 1][c]);
        triangles.emplace_back(down[r][c], down[r + 1][c + 1], down[r][c + 1]);
        triangles.emplace_back(down[r][c], down[r + 1][c], down[r + 1][c + 1]);
      }
    }
    mesh.vertices.resize(Eigen::Index(points.size()), 3);
    for (size_t v = 0; v < points.size(); ++v) mesh.vertices.row(Eigen::Index(v)) = points[v].transpose();
    mesh.triangles.resize(Eigen::Index(triangles.size()), 3);
    for (size_t t = 0; t < triangles.size(); ++t) mesh.triangles.row(Eigen::Index(t)) = triangles[t].transpose();
    edges = {up[0], down[0]};
  }
};

const SeamFrame kFrame{Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()};

double Greatest(const std::vector<double>& values) {
  return *std::ranges::max_element(values);
}
double Least(const std::vector<double>& values) {
  return *std::ranges::min_element(values);
}

TEST(Seam, FrameIsThatOfItsCornersAndTheWayOut) {
  const Slit slit(0.5);
  const SeamFrame frame = FrameOfSeam(slit.edges, slit.mesh.vertices, {1, 0, 2});
  EXPECT_TRUE(frame.along.isApprox(Eigen::Vector3d::UnitX()));
  EXPECT_TRUE(frame.up.isApprox(Eigen::Vector3d::UnitY()));
  EXPECT_TRUE(frame.out.isApprox(Eigen::Vector3d::UnitZ()));
}

TEST(Seam, MeetBringsBothEdgesToOneCurve) {
  const Slit slit(0.5);
  const Seam seam(slit.mesh, slit.edges, 2);
  geometry::Points pose = slit.mesh.vertices;
  EXPECT_NEAR(Greatest(seam.Heights(kFrame, pose)), 1, 1e-9) << "in the middle, by hand";
  seam.Meet(kFrame, 0.75, SeamDepth::kBetween, pose);
  EXPECT_LT(Greatest(seam.Gaps(pose)), 1e-3);
  const int middle = slit.edges.upper[3];
  EXPECT_NEAR(pose(middle, 1), 0.5 - 0.75 * 1, 1e-9);
  EXPECT_NEAR(pose(middle, 2), 0.75 * -0.1, 1e-9) << "the lower edge is 0.1 farther back";
  EXPECT_EQ(pose.row(slit.edges.upper.front()), slit.mesh.vertices.row(slit.edges.upper.front()));
  pose = slit.mesh.vertices;
  seam.Meet(kFrame, 0.75, SeamDepth::kFarther, pose);
  EXPECT_NEAR(pose(middle, 2), 0, 1e-9) << "as far out as the upper edge";
}

/// An upper edge of seven vertices and a lower one of four.
TEST(Seam, EdgesOfOtherNumbersOfVerticesMeetAlongTheirWholeLength) {
  Slit slit(0.5);
  SeamEdges edges = slit.edges;
  edges.lower = {edges.lower[0], edges.lower[2], edges.lower[3], edges.lower[6]};
  const Seam seam(slit.mesh, edges, 2);
  geometry::Points pose = slit.mesh.vertices;
  seam.Join(kFrame, 0.5, SeamDepth::kBetween, pose);
  EXPECT_LT(Greatest(seam.Gaps(pose)), 1e-9);
  EXPECT_TRUE(pose.row(edges.upper[2]).isApprox(pose.row(edges.lower[1]), 1e-12)) << "the nearest by length";
  EXPECT_TRUE(pose.row(edges.upper[3]).isApprox(pose.row(edges.lower[2]), 1e-12));
}

TEST(Seam, SkinBeyondItsRingsStays) {
  const Slit slit(0.5);
  geometry::Points pose = slit.mesh.vertices;
  Seam(slit.mesh, slit.edges, 2).Meet(kFrame, 0.5, SeamDepth::kBetween, pose);
  for (int v = 0; v < pose.rows(); ++v) {
    if (std::abs(slit.mesh.vertices(v, 1)) < 3) continue;
    EXPECT_EQ(pose.row(v), slit.mesh.vertices.row(v));
  }
}

TEST(Seam, KeepApartPartsEdgesThatCross) {
  const Slit slit(0.5);
  const Seam seam(slit.mesh, slit.edges, 2);
  geometry::Points crossed = slit.mesh.vertices;
  for (const int v : slit.edges.upper) crossed(v, 1) -= 1.5 * (1 - crossed(v, 0) * crossed(v, 0) / 9);
  EXPECT_LT(Least(seam.Heights(kFrame, crossed)), -0.3);
  seam.KeepApart(kFrame, slit.mesh.vertices, 0, crossed);
  EXPECT_GT(Least(seam.Heights(kFrame, crossed)), -0.05);
}

TEST(Seam, KeepApartLeavesAShareOfTheOpening) {
  const Slit slit(0.5);
  const Seam seam(slit.mesh, slit.edges, 2);
  geometry::Points closed = slit.mesh.vertices;
  seam.Meet(kFrame, 1, SeamDepth::kBetween, closed);
  seam.KeepApart(kFrame, slit.mesh.vertices, 0.25, closed);
  EXPECT_NEAR(Greatest(seam.Heights(kFrame, closed)), 0.25, 0.01) << "of 1 in the middle";

  geometry::Points open = slit.mesh.vertices;
  seam.KeepApart(kFrame, slit.mesh.vertices, 0.25, open);
  EXPECT_EQ(open, slit.mesh.vertices) << "wider than that, nothing moves";
}

TEST(Seam, RefusesEdgesThatDoNotShareCorners) {
  const Slit slit(0.5);
  SeamEdges other = slit.edges;
  other.lower.pop_back();
  testing::ExpectError([&] { Seam seam(slit.mesh, other, 2); }, "expected the same corners");
  testing::ExpectError([&] { Seam seam(slit.mesh, {{0, 1}, {0, 1}}, 2); }, "edges of 2 and 2 vertices");
}

}  // namespace
}  // namespace daumier::rig
