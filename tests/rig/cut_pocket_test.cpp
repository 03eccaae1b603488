#include "rig/cut_pocket.h"

#include "geometry/topology.h"
#include "tests/rig/slit_sheet.h"

#include <gtest/gtest.h>

namespace daumier::rig {
namespace {

/// A sheet of 10 cm a side, cut along y = 4.9 from about x = 2.5 to 7.5.
struct CutSheet {
  geometry::LineCut cut;
  SeamLine line;

  CutSheet() {
    geometry::TriangleMesh sheet = testing::FlatSheet(40);
    sheet.vertices *= 10;
    sheet.uv = 0.1 * sheet.vertices.leftCols(2);
    sheet.uv_triangles = sheet.triangles;
    const Eigen::VectorXd values = sheet.vertices.col(1).array() - 4.9;
    cut = geometry::CutAlongLine(sheet, values, [&](const geometry::EdgePoint& point) {
      const double x =
          (1 - point.share) * sheet.vertices(point.kept, 0) + point.share * sheet.vertices(point.removed, 0);
      return x > 2.4 && x < 7.6;
    });
    line.frame = {.along = {1, 0, 0}, .up = {0, 1, 0}, .out = {0, 0, 1}};
    line.origin = {2.5, 4.9, 0};
    line.width = 5;
    line.heights = line.depths = Eigen::VectorXd::Zero(11);
  }
};

TEST(CutPocket, ClosesTheCutWithASurfaceBehindIt) {
  CutSheet sheet;
  const Eigen::Index num_vertices = sheet.cut.mesh.vertices.rows(), num_triangles = sheet.cut.mesh.triangles.rows();
  const geometry::Points before = sheet.cut.mesh.vertices;
  AddPocket(sheet.line, sheet.cut);
  const geometry::TriangleMesh& mesh = sheet.cut.mesh;
  EXPECT_EQ(mesh.vertices.topRows(num_vertices), before);
  EXPECT_NEAR(mesh.vertices.col(2).minCoeff(), -0.45 * 5, 1e-9);
  EXPECT_LT(mesh.vertices.col(2).maxCoeff(), 1e-9);
  ASSERT_EQ(std::ssize(sheet.cut.sources), mesh.triangles.rows());
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
    EXPECT_EQ(sheet.cut.sources[size_t(t)] == -1, t >= num_triangles) << t;
  for (Eigen::Index t = num_triangles; t < mesh.triangles.rows(); ++t)
    EXPECT_GE(mesh.triangles.row(t).minCoeff(), num_vertices) << "vertices of its own";
  EXPECT_EQ(mesh.uv_triangles.rows(), mesh.triangles.rows());
  EXPECT_LT(mesh.uv_triangles.maxCoeff(), mesh.uv.rows());
}

TEST(CutPocket, IsOpenAtTheSlitAlone) {
  CutSheet sheet;
  const Eigen::Index num_triangles = sheet.cut.mesh.triangles.rows();
  AddPocket(sheet.line, sheet.cut);
  const geometry::Triangles pocket =
      sheet.cut.mesh.triangles.bottomRows(sheet.cut.mesh.triangles.rows() - num_triangles);
  const auto loops = geometry::BoundaryLoops(pocket, int(sheet.cut.mesh.vertices.rows()));
  ASSERT_EQ(loops.size(), 1u);
  for (const int v : loops[0]) EXPECT_NEAR(sheet.cut.mesh.vertices(v, 2), 0, 1e-6);
}

}  // namespace
}  // namespace daumier::rig
