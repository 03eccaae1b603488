#include "rig/head_slits.h"

#include "tests/rig/slit_sheet.h"

#include <gtest/gtest.h>

namespace daumier::rig {
namespace {

TemplateMatch MatchOf(const testing::SlitSheet& sheet) {
  return {sheet.mesh, sheet.slits, SidesOfTemplate(sheet.mesh, sheet.slits)};
}

/// A sheet as large as a head, whose lips are a little apart: places that touch would be one.
testing::SlitSheet LargeSheet(int n, double gap) {
  testing::SlitSheet sheet = testing::MakeSlitSheet(n);
  const SeamEdges& edges = sheet.slits[0];
  sheet.mesh.vertices *= 10;
  for (size_t i = 1; i + 1 < edges.lower.size(); ++i) sheet.mesh.vertices(edges.lower[i], 1) -= gap;
  return sheet;
}

TEST(HeadSlits, AreFloodedAlongEdgesThatDoNotCrossThem) {
  const testing::SlitSheet coarse = LargeSheet(16, 0.05), fine = LargeSheet(32, 0.02);
  const HeadSurface head = MakeHeadSurface(fine.mesh);
  const HeadSlits found = FindHeadSlits(MatchOf(coarse), head);
  const SeamEdges& edges = fine.slits[0];
  const auto side = [&](int v) { return found.sides[size_t(head.places[size_t(v)])]; };
  for (size_t i = 2; i + 2 < edges.upper.size(); ++i) {
    EXPECT_EQ(side(edges.upper[i]), FaceSide::kUpperLip);
    EXPECT_EQ(side(edges.lower[i]), FaceSide::kLowerLip);
  }
  const HeadSlit& mouth = found.slits[size_t(FaceSlit::kMouth)];
  EXPECT_TRUE(mouth.is_found);
  EXPECT_FALSE(mouth.is_sealed);
  EXPECT_NEAR(mouth.gap, 0.02, 1e-9);
  EXPECT_GT(mouth.way, 2.5) << "around a corner";
  EXPECT_FALSE(found.slits[size_t(FaceSlit::kLeftEye)].is_found) << "the template has no eyes";
}

TEST(HeadSlits, AreSealedWhereTheSurfaceContinues) {
  geometry::TriangleMesh closed = testing::FlatSheet(32);
  const Eigen::RowVector3d low = closed.vertices.colwise().minCoeff(),
                           size = closed.vertices.colwise().maxCoeff() - low;
  for (auto p : closed.vertices.rowwise())
    p = 10 * Eigen::RowVector3d((p.x() - low.x()) / size.x(), (p.y() - low.y()) / size.y(), 0);
  const HeadSlits found = FindHeadSlits(MatchOf(LargeSheet(16, 0.05)), MakeHeadSurface(closed));
  EXPECT_TRUE(found.slits[size_t(FaceSlit::kMouth)].is_sealed);
  EXPECT_LT(found.slits[size_t(FaceSlit::kMouth)].way, 0.7);
}

}  // namespace
}  // namespace daumier::rig
