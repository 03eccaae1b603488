#include "rig/seam_cut.h"

#include "geometry/topology.h"
#include "tests/rig/slit_sheet.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace daumier::rig {
namespace {

/// A sheet of 10 cm a side without a slit, and the template of one whose lips are 0.05 cm apart.
class SealedSheet : public ::testing::Test {
 protected:
  SealedSheet() {
    template_.mesh.vertices *= 10;
    const SeamEdges& edges = template_.slits[0];
    for (size_t i = 1; i + 1 < edges.lower.size(); ++i) template_.mesh.vertices(edges.lower[i], 1) -= 0.05;
    sheet_.vertices *= 10;
    sheet_.uv = 0.1 * sheet_.vertices.leftCols(2);
    sheet_.uv_triangles = sheet_.triangles;
  }
  TemplateMatch Match() const {
    return {template_.mesh, template_.slits, SidesOfTemplate(template_.mesh, template_.slits)};
  }
  OpenedHead Open(const geometry::TriangleMesh& head, const std::vector<HeadPart>& parts) const {
    const HeadSurface surface = MakeHeadSurface(head);
    return OpenSealedSlits(Match(), surface, {.of_components = parts, .eyes = {}}, FindHeadSlits(Match(), surface),
                           head);
  }

  testing::SlitSheet template_ = testing::MakeSlitSheet(16);
  geometry::TriangleMesh sheet_ = testing::FlatSheet(44);
};

TEST_F(SealedSheet, IsOpenedFromCornerToCorner) {
  const OpenedHead opened = Open(sheet_, {HeadPart::kSkin});
  EXPECT_EQ(opened.slits, (std::array{SlitCut::kCut, SlitCut::kNotSealed, SlitCut::kNotSealed}));
  EXPECT_NEAR(opened.lengths[0], 5, 0.3) << "ends are at most an edge away from the corners";
  EXPECT_EQ(opened.mesh.vertices.topRows(sheet_.vertices.rows()), sheet_.vertices);
  EXPECT_GT(opened.num_cut_vertices, 20);
  const HeadSurface surface = MakeHeadSurface(opened.mesh);
  const HeadSlit mouth = FindHeadSlits(Match(), surface).slits[0];
  EXPECT_TRUE(mouth.is_found);
  EXPECT_FALSE(mouth.is_sealed) << mouth.way << " cm, gap " << mouth.gap;
}

TEST_F(SealedSheet, GetsAPocketBehindIt) {
  const OpenedHead opened = Open(sheet_, {HeadPart::kSkin});
  const geometry::Triangles welded = MakeHeadSurface(opened.mesh).mesh.triangles;
  ASSERT_EQ(welded.rows(), opened.mesh.triangles.rows());
  EXPECT_NO_THROW(geometry::CheckManifold(welded, 1 + welded.maxCoeff())) << "oriented as the sheet";
  EXPECT_EQ(geometry::EulerCharacteristic(welded), 1) << "a disc again: the pocket is closed";
  EXPECT_NEAR(opened.mesh.vertices.col(2).minCoeff(), -0.45 * 5, 1e-9);
  const auto first = std::ranges::find(opened.sources, -1);
  ASSERT_NE(first, opened.sources.end());
  EXPECT_TRUE(std::all_of(first, opened.sources.end(), [](int source) { return source == -1; }));
  EXPECT_EQ(opened.mesh.uv_triangles.rows(), opened.mesh.triangles.rows());
  EXPECT_LT(opened.mesh.uv_triangles.maxCoeff(), opened.mesh.uv.rows());
}

TEST_F(SealedSheet, GetsNoPocketWhereThereAreTeeth) {
  geometry::TriangleMesh head = sheet_;
  const int num_sheet = int(head.vertices.rows());
  head.vertices.conservativeResize(num_sheet + 3, 3);
  head.vertices.bottomRows(3) << 5, 4.5, -1, 5.2, 4.5, -1, 5, 4.8, -1;
  head.triangles.conservativeResize(head.triangles.rows() + 1, 3);
  head.triangles.bottomRows(1) << num_sheet, num_sheet + 1, num_sheet + 2;
  head.uv_triangles.conservativeResize(head.triangles.rows(), 3);
  head.uv_triangles.bottomRows(1).setZero();
  const OpenedHead opened = Open(head, {HeadPart::kSkin, HeadPart::kLowerMouth});
  EXPECT_EQ(opened.slits[0], SlitCut::kCut);
  EXPECT_EQ(opened.mesh.vertices.rows(), head.vertices.rows() + opened.num_cut_vertices);
  EXPECT_EQ(std::ranges::find(opened.sources, -1), opened.sources.end());
}

TEST_F(SealedSheet, IsNotCutWhereItIsOpen) {
  testing::SlitSheet open = testing::MakeSlitSheet(32);
  open.mesh.vertices *= 10;
  for (size_t i = 1; i + 1 < open.slits[0].lower.size(); ++i) open.mesh.vertices(open.slits[0].lower[i], 1) -= 0.02;
  const OpenedHead opened = Open(open.mesh, {HeadPart::kSkin});
  EXPECT_EQ(opened.slits[0], SlitCut::kNotSealed);
  EXPECT_EQ(opened.mesh.triangles, open.mesh.triangles);
  EXPECT_EQ(opened.mesh.vertices, open.mesh.vertices);
}

TEST_F(SealedSheet, IsCutAtLidsOnlyWhereTheseAreClosed) {
  template_.slits[size_t(FaceSlit::kLeftEye)] = template_.slits[0];
  template_.slits[0] = {};
  EXPECT_EQ(Open(sheet_, {HeadPart::kSkin}).slits[size_t(FaceSlit::kLeftEye)], SlitCut::kCut);
  const SeamEdges& lids = template_.slits[size_t(FaceSlit::kLeftEye)];
  for (size_t i = 1; i + 1 < lids.lower.size(); ++i) template_.mesh.vertices(lids.lower[i], 1) -= 1.3 * kClosedEye * 5;
  EXPECT_EQ(Open(sheet_, {HeadPart::kSkin}).slits[size_t(FaceSlit::kLeftEye)], SlitCut::kOpenEye);
}

}  // namespace
}  // namespace daumier::rig
