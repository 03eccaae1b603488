#include "geometry/orientation.h"

#include "core/random.h"
#include "geometry/obj.h"
#include "geometry/triangulate.h"
#include "tests/geometry/shapes.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

namespace daumier::geometry {
namespace {

/// The mesh with those triangles turned for which `is_turned(middle)` holds.
template <class IsTurned>
TriangleMesh TurnedWhere(TriangleMesh mesh, const IsTurned& is_turned) {
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    const Vector3 middle = mesh.vertices(mesh.triangles.row(f), Eigen::all).colwise().mean().transpose();
    if (is_turned(middle)) std::swap(mesh.triangles(f, 0), mesh.triangles(f, 1));
  }
  return mesh;
}
TriangleMesh InsideOut(const TriangleMesh& mesh) {
  return TurnedWhere(mesh, [](const Vector3&) { return true; });
}

/// A half sphere, open downwards.
TriangleMesh Dome(int depth) {
  TriangleMesh mesh = testing::Sphere(1, depth);
  std::vector<int> kept;
  for (int f = 0; f < mesh.triangles.rows(); ++f) {
    if (mesh.vertices(mesh.triangles.row(f), 1).minCoeff() > -1e-9) kept.push_back(f);
  }
  mesh.triangles = Triangles(mesh.triangles(kept, Eigen::all));
  return mesh;
}

/// The cyclic order of each triangle's corners that begins with the lowest.
Triangles Canonical(Triangles triangles) {
  for (auto t : triangles.rowwise()) {
    while (t[0] != t.minCoeff()) t = Eigen::RowVector3i(t[1], t[2], t[0]);
  }
  return triangles;
}

void ExpectTurnedBack(const TriangleMesh& turned, const TriangleMesh& expected, const char* what) {
  EXPECT_EQ(Canonical(OrientOutwards(turned).triangles), Canonical(expected.triangles)) << what;
}

TEST(Outwardness, IsOneOfASphereAndMinusOneInsideOut) {
  const TriangleMesh ball = testing::Sphere(2, 4);
  EXPECT_NEAR(Outwardness(ball), 1, 0.01);
  EXPECT_NEAR(Outwardness(InsideOut(ball)), -1, 0.01);
  EXPECT_NEAR(Outwardness(testing::FlatSheet(4)), 0, 1e-12);
  EXPECT_EQ(Outwardness({Points::Zero(3, 3), (Triangles(1, 3) << 0, 1, 2).finished()}), 0);
}

// Flux and mean distance of a dome worked out by hand: its area's middle is at height 1/2; the flux is 2 pi - pi / 2, and
// the mean of sqrt(5/4 - z) over z in [0, 1] is (2/3) ((5/4)^1.5 - (1/4)^1.5).
TEST(Outwardness, OfADomeIsWorkedOutByHand) {
  EXPECT_NEAR(Outwardness(Dome(5)), 0.75 / (2.0 / 3 * (std::pow(1.25, 1.5) - std::pow(0.25, 1.5))), 0.01);
}

TEST(OrientOutwards, LeavesWhatIsWoundOutwards) {
  for (const TriangleMesh& mesh :
       {testing::Sphere(1, 2), testing::Torus(3, 1, 12, 8), Dome(2), testing::FlatSheet(3)}) {
    const OrientedSurface oriented = OrientOutwards(mesh);
    EXPECT_EQ(oriented.num_turned, 0);
    EXPECT_EQ(oriented.triangles, mesh.triangles);
  }
}

TEST(OrientOutwards, TurnsWhatIsInsideOut) {
  for (const TriangleMesh& mesh : {testing::Sphere(1, 2), testing::Torus(3, 1, 12, 8), Dome(2)}) {
    ExpectTurnedBack(InsideOut(mesh), mesh, "inside out");
    EXPECT_EQ(OrientOutwards(InsideOut(mesh)).num_turned, mesh.triangles.rows());
  }
}

TEST(OrientOutwards, WindsAlikeWhatIsMixed) {
  for (const TriangleMesh& mesh : {testing::Sphere(1, 3), testing::Torus(3, 1, 24, 16), Dome(3)}) {
    ExpectTurnedBack(TurnedWhere(mesh, [](const Vector3& p) { return p.x() > 0; }), mesh, "a mirrored half");
    ExpectTurnedBack(TurnedWhere(mesh, [](const Vector3& p) { return p.x() > -0.5; }), mesh, "more than a half");
    Rng rng(5);
    ExpectTurnedBack(TurnedWhere(mesh, [&](const Vector3&) { return rng.Below(4) == 0; }), mesh, "a random quarter");
  }
}

TEST(OrientOutwards, LeavesSheetsThatMeetAtTheirBordersAndOneSidedSurfaces) {
  // Two sheets over each other, both facing up, joined at one side.
  TriangleMesh sheets{Points(6, 3), Triangles(4, 3)};
  sheets.vertices << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 1, 1, 0.1, 0, 1, 0.1;
  sheets.triangles << 0, 1, 2, 0, 2, 3, 0, 1, 4, 0, 4, 5;
  EXPECT_EQ(OrientOutwards(sheets).num_turned, 0);
  // A Moebius strip.
  constexpr int kSteps = 20;
  TriangleMesh strip{Points(2 * kSteps, 3), Triangles(2 * kSteps, 3)};
  for (int i = 0; i < kSteps; ++i) {
    const double a = 2 * std::numbers::pi * i / kSteps;
    for (const int side : {0, 1}) {
      const double w = side - 0.5, radius = 3 + w * std::cos(a / 2);
      strip.vertices.row(2 * i + side) << radius * std::cos(a), radius * std::sin(a), w * std::sin(a / 2);
    }
    const bool is_last = i + 1 == kSteps;
    const int low = is_last ? 1 : 2 * i + 2, high = is_last ? 0 : 2 * i + 3;
    strip.triangles.row(2 * i) << 2 * i, low, high;
    strip.triangles.row(2 * i + 1) << 2 * i, high, 2 * i + 1;
  }
  EXPECT_EQ(OrientOutwards(strip).num_turned, 0);
}

TEST(OrientOutwards, LeavesTheHeadsOfArtistsAndScanners) {
  const auto shared = testing::SharedData();
  if (!shared || !std::filesystem::exists(*shared / "caricatures/1.obj"))
    GTEST_SKIP() << "the caricatures are not there; set DAUMIER_SHARED_DATA";
  for (const char* file : {"caricatures/1.obj", "caricatures/22.obj", "head_poses/head-08-smile.obj",
                           "facewarehouse_topology/warehouse_0.obj"}) {
    const PolygonMesh polygons = ReadObj(*shared / file);
    const TriangleMesh mesh{polygons.vertices, Triangulate(polygons)};
    EXPECT_GT(Outwardness(mesh), 0.4) << file;
    EXPECT_EQ(OrientOutwards(mesh).num_turned, 0) << file;
    ExpectTurnedBack(InsideOut(mesh), mesh, file);
  }
}

}  // namespace
}  // namespace daumier::geometry
