#include "geometry/line_cut.h"

#include "geometry/normals.h"
#include "geometry/topology.h"
#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::geometry {
namespace {

TriangleMesh SheetToOpen(int n) {
  TriangleMesh mesh = testing::FlatSheet(n);
  mesh.uv = mesh.vertices.leftCols(2);
  mesh.uv_triangles = mesh.triangles;
  return mesh;
}

/// The part of a line between these x.
auto Between(const TriangleMesh& mesh, double low, double high) {
  return [&mesh, low, high](const EdgePoint& point) {
    const double x = (1 - point.share) * mesh.vertices(point.kept, 0) + point.share * mesh.vertices(point.removed, 0);
    return x >= low && x <= high;
  };
}

size_t NumLoops(const TriangleMesh& mesh) {
  return BoundaryLoops(mesh.triangles, int(mesh.vertices.rows())).size();
}

/// What every cut keeps.
void ExpectSameSurface(const TriangleMesh& before, const LineCut& cut) {
  EXPECT_EQ(cut.mesh.vertices.topRows(before.vertices.rows()), before.vertices) << "vertices keep their numbers";
  EXPECT_NEAR(TriangleAreas(cut.mesh).sum(), TriangleAreas(before).sum(), 1e-9);
  EXPECT_NO_THROW(CheckManifold(cut.mesh.triangles, int(cut.mesh.vertices.rows())));
  ASSERT_EQ(std::ssize(cut.sources), cut.mesh.triangles.rows());
  const Points own = TriangleNormals(before), normals = TriangleNormals(cut.mesh);
  const Eigen::VectorXd pieces = TriangleAreas(cut.mesh);
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(before.triangles.rows());
  for (Eigen::Index t = 0; t < cut.mesh.triangles.rows(); ++t) {
    const int source = cut.sources[size_t(t)];
    EXPECT_GT(normals.row(t).dot(own.row(source)), 1 - 1e-9) << "orientation";
    areas[source] += pieces[t];
    if (t < before.triangles.rows()) EXPECT_EQ(source, t) << "rows of whole triangles stay";
  }
  EXPECT_LT((areas - TriangleAreas(before)).cwiseAbs().maxCoeff(), 1e-12) << "pieces cover their triangle";
  for (const RimVertex& place : cut.rim)
    EXPECT_EQ(cut.mesh.vertices.row(place.below), cut.mesh.vertices.row(place.above));
}

TEST(LineCut, OpensASheetBetweenTheEndsOfTheLine) {
  const TriangleMesh sheet = SheetToOpen(16);
  const LineCut cut =
      CutAlongLine(sheet, sheet.vertices.col(1).array() - 0.47, Between(sheet, 0.25 - 1e-9, 0.75 + 1e-9));
  ExpectSameSurface(sheet, cut);
  EXPECT_EQ(NumLoops(cut.mesh), NumLoops(sheet) + 1);
  EXPECT_EQ(EulerCharacteristic(cut.mesh.triangles), EulerCharacteristic(sheet.triangles) - 1);
  EXPECT_NEAR(cut.length, 0.5, 1e-12);
  int num_ends = 0;
  for (const RimVertex& place : cut.rim) {
    EXPECT_NEAR(cut.mesh.vertices(place.below, 1), 0.47, 1e-12);
    num_ends += place.below == place.above ? 1 : 0;
  }
  EXPECT_EQ(num_ends, 2);
  for (Eigen::Index t = 0; t < cut.mesh.triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k)
      EXPECT_LT(
          (cut.mesh.uv.row(cut.mesh.uv_triangles(t, k)) - cut.mesh.vertices.row(cut.mesh.triangles(t, k)).leftCols(2))
              .norm(),
          1e-12);
}

TEST(LineCut, GivesWhatIsAboveVerticesOfItsOwn) {
  const TriangleMesh sheet = SheetToOpen(16);
  const LineCut cut = CutAlongLine(sheet, sheet.vertices.col(1).array() - 0.47, Between(sheet, 0.25, 0.75));
  for (const RimEdge& edge : cut.edges) {
    EXPECT_LT(testing::MiddleOf(cut.mesh, cut.mesh.triangles.row(edge.triangle_below), 1), 0.47);
    EXPECT_GT(testing::MiddleOf(cut.mesh, cut.mesh.triangles.row(edge.triangle_above), 1), 0.47);
    const RimVertex &from = cut.rim[size_t(edge.from)], &to = cut.rim[size_t(edge.to)];
    const auto runs = [&](int triangle, int a, int b) {
      for (int k = 0; k < 3; ++k)
        if (cut.mesh.triangles(triangle, k) == a && cut.mesh.triangles(triangle, (k + 1) % 3) == b) return true;
      return false;
    };
    EXPECT_TRUE(runs(edge.triangle_below, from.below, to.below));
    EXPECT_TRUE(runs(edge.triangle_above, to.above, from.above));
  }
}

TEST(LineCut, GoesThroughVerticesOnItAndNearIt) {
  const TriangleMesh sheet = SheetToOpen(16);
  for (const double height : {0.5, 0.505}) {
    const LineCut cut =
        CutAlongLine(sheet, sheet.vertices.col(1).array() - height, Between(sheet, 0.25 - 1e-9, 0.75 + 1e-9));
    ExpectSameSurface(sheet, cut);
    EXPECT_EQ(cut.mesh.triangles.rows(), sheet.triangles.rows()) << "no triangle is split";
    EXPECT_EQ(cut.mesh.vertices.rows(), sheet.vertices.rows() + 7) << "those between the ends of nine are doubled";
    EXPECT_EQ(EulerCharacteristic(cut.mesh.triangles), EulerCharacteristic(sheet.triangles) - 1);
  }
}

TEST(LineCut, MayCrossASheetFromBorderToBorder) {
  const TriangleMesh sheet = SheetToOpen(8);
  const LineCut cut =
      CutAlongLine(sheet, sheet.vertices * Eigen::Vector3d(0.3, 1, 0) - Eigen::VectorXd::Constant(81, 0.6),
                   [](const EdgePoint&) { return true; });
  ExpectSameSurface(sheet, cut);
  EXPECT_EQ(NumLoops(cut.mesh), 2u) << "two sheets";
  EXPECT_NEAR(cut.length, std::hypot(1, 0.3), 0.01) << "through vertices that are near";
}

TEST(LineCut, OpensASphereAlongACurve) {
  const TriangleMesh ball = testing::Sphere(3, 4);
  const Eigen::VectorXd values = ball.vertices.col(1).array() - 0.1 * (3 * ball.vertices.col(0).array()).sin() - 0.013;
  const LineCut cut = CutAlongLine(ball, values, [&](const EdgePoint& point) {
    const Eigen::RowVector3d at =
        (1 - point.share) * ball.vertices.row(point.kept) + point.share * ball.vertices.row(point.removed);
    return at.z() > 0 && std::abs(at.x()) < 1.5;
  });
  ExpectSameSurface(ball, cut);
  EXPECT_EQ(EulerCharacteristic(cut.mesh.triangles), 1);
  EXPECT_EQ(NumLoops(cut.mesh), 1u);
}

TEST(LineCut, ChangesNothingWithoutALine) {
  const TriangleMesh sheet = SheetToOpen(4);
  const LineCut cut = CutAlongLine(sheet, sheet.vertices.col(1).array() - 0.3, [](const EdgePoint&) { return false; });
  EXPECT_EQ(cut.mesh.triangles, sheet.triangles);
  EXPECT_EQ(cut.mesh.vertices, sheet.vertices);
  EXPECT_EQ(cut.mesh.uv, sheet.uv);
  EXPECT_TRUE(cut.edges.empty());
}

TEST(LineCut, RefusesWrongValues) {
  const TriangleMesh sheet = SheetToOpen(1);
  const auto anywhere = [](const EdgePoint&) { return true; };
  testing::ExpectError([&] { CutAlongLine(sheet, Eigen::Vector3d::Zero(), anywhere); },
                       "3 values were given for 4 vertices");
  testing::ExpectError([&] { CutAlongLine(sheet, Eigen::Vector4d(0, 1, NAN, 1), anywhere); }, "not all finite");
}

}  // namespace
}  // namespace daumier::geometry
