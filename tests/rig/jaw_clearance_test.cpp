#include "rig/jaw_clearance.h"

#include "tests/rig/slit_sheet.h"

#include <gtest/gtest.h>

namespace daumier::rig {
namespace {

/// A sheet of skin with a tooth 0.3 cm behind it.
TEST(JawClearance, PushesTeethBackByHowMuchTheSkinBeforeThemComesBack) {
  testing::SlitSheet sheet = testing::MakeSlitSheet(32);
  sheet.mesh.vertices *= 10;
  const SeamEdges& edges = sheet.slits[0];
  for (size_t i = 1; i + 1 < edges.lower.size(); ++i) sheet.mesh.vertices(edges.lower[i], 1) -= 0.01;
  const TemplateMatch match(sheet.mesh, sheet.slits, SidesOfTemplate(sheet.mesh, sheet.slits));
  const int num_skin = int(sheet.mesh.vertices.rows());
  sheet.mesh.vertices.conservativeResize(num_skin + 3, 3);
  sheet.mesh.vertices.bottomRows(3) << 5, 4.5, -0.3, 5.1, 4.5, -0.3, 5, 4.6, -0.3;
  sheet.mesh.triangles.conservativeResize(sheet.mesh.triangles.rows() + 1, 3);
  sheet.mesh.triangles.bottomRows(1) << num_skin, num_skin + 1, num_skin + 2;
  const HeadSurface head = MakeHeadSurface(sheet.mesh);
  HeadParts parts{{HeadPart::kSkin, HeadPart::kLowerMouth}, {}, {}};
  parts.jaw_shares.assign(size_t(head.num_places()), 0.0f);
  std::fill(parts.jaw_shares.end() - 3, parts.jaw_shares.end(), 1.0f);
  const JawClearance clearance(head, parts, match);
  Eigen::VectorXf offsets = Eigen::VectorXf::Zero(3 * head.num_places());
  EXPECT_EQ(clearance.PushOf(Eigen::Isometry3d::Identity(), offsets), 0);
  for (int p = 0; p < num_skin; ++p) offsets[3 * p + 2] = -0.5f;
  EXPECT_NEAR(clearance.PushOf(Eigen::Isometry3d::Identity(), offsets), 0.25, 1e-6);
  // Teeth that go down as the skin does keep their place behind it.
  Eigen::Isometry3d down = Eigen::Isometry3d::Identity();
  down.translation() = Eigen::Vector3d(0, -1, 0);
  offsets.setZero();
  for (int p = 0; p < num_skin; ++p) offsets[3 * p + 1] = -1;
  EXPECT_EQ(clearance.PushOf(down, offsets), 0);
}

}  // namespace
}  // namespace daumier::rig
