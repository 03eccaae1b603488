#include "rig/cut_pocket.h"

#include "tests/rig/slit_sheet.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace daumier::rig {
namespace {

TEST(CutPocket, BeginsAtTheCutAndGoesBackByAShareOfItsWidth) {
  const testing::SlitSheet slit = testing::MakeSlitSheet(16);
  const SeamLine line = MiddleOfSlit(slit.slits[0], slit.mesh.vertices);
  const geometry::TriangleMesh sheet = testing::FlatSheet(16);
  geometry::LineCut cut =
      geometry::CutAlongLine(sheet, sheet.vertices.col(1).array() - 0.5, [&](const geometry::EdgePoint& point) {
        const double x = sheet.vertices(point.kept, 0);
        return x > 0.24 && x < 0.76;
      });
  const geometry::TriangleMesh before = cut.mesh;
  AddPocket(line, cut);
  EXPECT_EQ(cut.mesh.vertices.topRows(before.vertices.rows()), before.vertices);
  EXPECT_EQ(cut.mesh.triangles.topRows(before.triangles.rows()), before.triangles);
  EXPECT_EQ(std::ranges::count(cut.sources, -1), cut.mesh.triangles.rows() - before.triangles.rows());
  EXPECT_GE(cut.mesh.triangles.bottomRows(cut.mesh.triangles.rows() - before.triangles.rows()).minCoeff(),
            before.vertices.rows())
      << "vertices of its own";
  EXPECT_NEAR(cut.mesh.vertices.col(2).minCoeff(), -0.45 * 0.5, 1e-9);
  EXPECT_EQ(cut.mesh.vertices.col(2).maxCoeff(), 0);
}

}  // namespace
}  // namespace daumier::rig
