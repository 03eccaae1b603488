#include "geometry/collapse_mesh.h"

#include "geometry/closed_surface.h"
#include "geometry/topology.h"
#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>
#include <vector>

namespace daumier::geometry {
namespace {

std::set<int> Set(const std::vector<int>& values) {
  return {values.begin(), values.end()};
}

CollapseMesh Plain(const TriangleMesh& mesh, std::vector<int> labels = {}) {
  return {mesh.triangles, mesh.triangles, std::move(labels), int(mesh.vertices.rows())};
}

Triangles AliveTriangles(const CollapseMesh& mesh) {
  Triangles alive(mesh.num_triangles(), 3);
  for (int f = 0, row = 0; f < mesh.triangles().rows(); ++f)
    if (mesh.IsAlive(f)) alive.row(row++) = mesh.triangles().row(f);
  return alive;
}

// 6 7 8
// 3 4 5   each square cut from its lower left to its upper right corner
// 0 1 2
TEST(CollapseMesh, InnerVerticesMayGoAnywhereThoseOfTheBorderAlongIt) {
  const CollapseMesh mesh = Plain(testing::FlatSheet(2));
  EXPECT_EQ(Set(mesh.Targets(4)), (std::set<int>{0, 1, 3, 5, 7, 8}));
  EXPECT_EQ(Set(mesh.Targets(1)), (std::set<int>{0, 2})) << "not to 4 and 5";
  EXPECT_EQ(Set(mesh.Neighbours(1)), (std::set<int>{0, 2, 4, 5}));
  EXPECT_EQ(mesh.FeatureEdges().size(), 8u) << "the sides of the sheet";
}

TEST(CollapseMesh, ACollapseRemovesTheTrianglesAtTheEdge) {
  CollapseMesh mesh = Plain(testing::FlatSheet(2));
  const auto collapse = mesh.Plan(4, 5);
  ASSERT_TRUE(collapse);
  EXPECT_EQ(collapse->removed.size(), 2u);
  mesh.Apply(*collapse);
  EXPECT_EQ(mesh.num_triangles(), 6);
  EXPECT_TRUE(mesh.TrianglesAt(4).empty());
  EXPECT_EQ(EulerCharacteristic(AliveTriangles(mesh)), 1);
  EXPECT_NO_THROW(CheckManifold(AliveTriangles(mesh), 9));
}

TEST(CollapseMesh, VerticesBetweenLabelsGoAlongTheirBorderAndForksStay) {
  // The lower row of squares has another label: 3, 4, 5 lie on the border.
  const CollapseMesh mesh = Plain(testing::FlatSheet(2), {0, 0, 0, 0, 1, 1, 1, 1});
  EXPECT_EQ(Set(mesh.Targets(4)), (std::set<int>{3, 5}));
  EXPECT_TRUE(mesh.Targets(3).empty()) << "three features meet";
}

TEST(CollapseMesh, WedgesFollowTheirSideOfASeam) {
  const TriangleMesh sheet = testing::FlatSheet(2);
  Triangles wedges = sheet.triangles;
  for (int f = 4; f < 8; ++f)
    for (int k = 0; k < 3; ++k)
      if (wedges(f, k) >= 3 && wedges(f, k) <= 5) wedges(f, k) += 10;  // 13, 14, 15 above the seam.
  CollapseMesh mesh(sheet.triangles, wedges, {}, 9);
  EXPECT_EQ(Set(mesh.Targets(4)), (std::set<int>{3, 5}));
  const auto collapse = mesh.Plan(4, 5);
  ASSERT_TRUE(collapse);
  EXPECT_EQ((std::set<std::pair<int, int>>(collapse->wedges.begin(), collapse->wedges.end())),
            (std::set<std::pair<int, int>>{{4, 5}, {14, 15}}));
  mesh.Apply(*collapse);
  for (int f = 0; f < 8; ++f)
    for (int k = 0; k < 3; ++k)
      if (mesh.IsAlive(f) && mesh.triangles()(f, k) == 5) {
        EXPECT_EQ(mesh.wedges()(f, k), f < 4 ? 5 : 15);
      }
}

TEST(CollapseMesh, TheEndOfASeamStays) {
  const TriangleMesh sheet = testing::FlatSheet(2);
  Triangles wedges = sheet.triangles;
  for (int f = 4; f < 8; ++f)
    for (int k = 0; k < 3; ++k)
      if (wedges(f, k) == 3) wedges(f, k) = 13;  // The edge 3-4 is a seam that ends at 4.
  EXPECT_TRUE(CollapseMesh(sheet.triangles, wedges, {}, 9).Targets(4).empty());
}

TEST(CollapseMesh, ATetrahedronStays) {
  Triangles tetrahedron(4, 3);
  tetrahedron << 0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3;
  const CollapseMesh mesh(tetrahedron, tetrahedron, {}, 4);
  for (int from = 0; from < 4; ++from)
    for (int to = 0; to < 4; ++to)
      if (from != to) {
        EXPECT_FALSE(mesh.Plan(from, to)) << from << " to " << to;
      }
}

TEST(CollapseMesh, VerticesOfThreeTrianglesAtAnEdgeAndOfTwoFansStay) {
  Triangles fin(3, 3);
  fin << 0, 1, 2, 1, 0, 3, 0, 1, 4;
  EXPECT_TRUE(CollapseMesh(fin, fin, {}, 5).Targets(0).empty());
  Triangles bow(2, 3);
  bow << 0, 1, 2, 0, 3, 4;
  EXPECT_TRUE(CollapseMesh(bow, bow, {}, 5).Targets(0).empty());
}

TEST(CollapseMesh, KeepsTheKindOfSurfaceUntilNothingIsLeftToCollapse) {
  const TriangleMesh torus = testing::Torus(2, 0.5, 12, 8);
  CollapseMesh mesh = Plain(torus);
  for (bool is_changed = true; is_changed;) {
    is_changed = false;
    for (int v = 0; v < torus.vertices.rows(); ++v) {
      for (const int to : mesh.Targets(v)) {
        const auto collapse = mesh.Plan(v, to);
        if (!collapse) continue;
        mesh.Apply(*collapse);
        is_changed = true;
        break;
      }
    }
  }
  EXPECT_LT(mesh.num_triangles(), 40);
  EXPECT_TRUE(IsClosed(AliveTriangles(mesh)));
  EXPECT_EQ(EulerCharacteristic(AliveTriangles(mesh)), 0);
  EXPECT_NO_THROW(CheckManifold(AliveTriangles(mesh), int(torus.vertices.rows())));
}

TEST(CollapseMesh, RefusesSizesThatDisagreeAndBadCorners) {
  const Triangles one = testing::EquilateralTriangle().triangles;
  testing::ExpectError([&] { CollapseMesh(one, Triangles(0, 3), {}, 3); }, "1 triangles have 0 rows of wedges");
  testing::ExpectError([&] { CollapseMesh(one, one, {1, 2}, 3); }, "1 triangles have 2 labels");
  testing::ExpectError([&] { CollapseMesh(one, one, {}, 2); }, "triangle 0 names a vertex that is not there");
  Triangles twice(1, 3);
  twice << 0, 1, 1;
  testing::ExpectError([&] { CollapseMesh(twice, twice, {}, 2); }, "triangle 0 has a vertex twice");
}

}  // namespace
}  // namespace daumier::geometry
