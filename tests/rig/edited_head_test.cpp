#include "rig/edited_head.h"

#include "tests/support/ball_head.h"

#include <gtest/gtest.h>

namespace daumier::rig {
namespace {

using testing::BallHead;

EditedMatch WholeMatch(const RiggedHead& head, bool with_eyes) {
  EditedMatch match;
  match.places = PlacesOf(head);
  match.is_matched.assign(size_t(match.places.rows()), with_eyes);
  for (Eigen::Index v = 0; v < head.mesh.vertices.rows(); ++v) match.is_matched[size_t(v)] = true;
  return match;
}

TEST(ApplyEdit, OfAnUneditedMeshGivesTheHead) {
  const RiggedHead head = BallHead();
  for (const bool with_eyes : {false, true}) {
    const EditedHead same = ApplyEdit(head, WholeMatch(head, with_eyes));
    EXPECT_EQ(same.head.mesh.vertices, head.mesh.vertices);
    EXPECT_EQ(same.head.targets.offsets, head.targets.offsets);
    EXPECT_LT((same.head.jaw_pivot - head.jaw_pivot).norm(), 1e-12);
    EXPECT_LT((same.head.eyes[0].centre - head.eyes[0].centre).norm(), 1e-12);
    EXPECT_EQ(same.most_edit_mm, 0);
    EXPECT_EQ(same.most_target_change_mm, 0);
    EXPECT_TRUE(same.most_changed_target.empty());
  }
}

TEST(ApplyEdit, ScalesAllOfAScaledHead) {
  RiggedHead head = BallHead();
  HeadAttachment tuft{"Hair", {geometry::Points(3, 3), geometry::Triangles(1, 3), {}, {}}, Eigen::MatrixXf(3, 3)};
  tuft.mesh.vertices << -1, 11.1, 0, 1, 11.1, 0, 0, 11.2, 0;
  tuft.mesh.triangles << 0, 1, 2;
  head.attachments.push_back(tuft);
  EditedMatch match = WholeMatch(head, false);
  const Eigen::Index count = head.mesh.vertices.rows();
  match.places.topRows(count) *= 1.25;
  const EditedHead larger = ApplyEdit(head, match);
  for (size_t e = 0; e < 2; ++e) {
    EXPECT_LT((larger.head.eyes[e].centre - 1.25 * head.eyes[e].centre).norm(), 1e-9);
    EXPECT_LT((larger.head.eyes[e].mesh.vertices - 1.25 * head.eyes[e].mesh.vertices).cwiseAbs().maxCoeff(), 1e-9);
  }
  EXPECT_LT((larger.head.jaw_pivot - 1.25 * head.jaw_pivot).norm(), 1e-9);
  EXPECT_LT((larger.head.head_pivot - 1.25 * head.head_pivot).norm(), 1e-9);
  EXPECT_NEAR(larger.head.attachments[0].mesh.vertices(2, 1), 11.2 + 0.25 * 11, 0.1) << "as the crown, 11 cm";
  EXPECT_EQ(larger.num_matched, count);
  EXPECT_NEAR(larger.most_edit_mm, 2.5 * head.mesh.vertices.rowwise().norm().maxCoeff(), 1e-9);
}

TEST(ApplyEdit, TakesEyesFromTheMeshWhereItHasThem) {
  const RiggedHead head = BallHead();
  EditedMatch match = WholeMatch(head, true);
  const Eigen::Index count = head.mesh.vertices.rows(), of_eye = head.eyes[0].mesh.vertices.rows();
  match.places.middleRows(count, of_eye).col(1).array() += 0.5;
  const EditedHead edited = ApplyEdit(head, match);
  EXPECT_LT((edited.head.eyes[0].centre - head.eyes[0].centre - geometry::Vector3(0, 0.5, 0)).norm(), 1e-9);
  EXPECT_LT((edited.head.eyes[0].mesh.vertices - head.eyes[0].mesh.vertices).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_EQ(edited.head.eyes[1].centre, head.eyes[1].centre);
  EXPECT_EQ(edited.most_edit_mm, 0) << "of the head's mesh";
}

/// A head with a second part: a small ball below the large one.
RiggedHead HeadWithChain() {
  RiggedHead head = BallHead();
  geometry::TriangleMesh ball = testing::UvBall(1, 4, 6);
  ball.vertices.rowwise() += Eigen::RowVector3d(0, -8.5, 2);
  const Eigen::Index v = head.mesh.vertices.rows(), f = head.mesh.triangles.rows();
  head.mesh.vertices.conservativeResize(v + ball.vertices.rows(), 3);
  head.mesh.vertices.bottomRows(ball.vertices.rows()) = ball.vertices;
  head.mesh.triangles.conservativeResize(f + ball.triangles.rows(), 3);
  head.mesh.triangles.bottomRows(ball.triangles.rows()) = ball.triangles.array() + int(v);
  head.mesh.uv.resize(0, 2);
  head.mesh.uv_triangles.resize(0, 3);
  head.materials.resize(size_t(head.mesh.triangles.rows()), faces::HeadMaterial::kTooth);
  const Eigen::MatrixXf offsets = head.targets.offsets;
  head.targets.offsets = Eigen::MatrixXf::Zero(3 * head.mesh.vertices.rows(), offsets.cols());
  head.targets.offsets.topRows(offsets.rows()) = offsets;
  return head;
}

TEST(ApplyEdit, MovesPartsThatTheMeshLacksAsWhatIsAroundThem) {
  const RiggedHead head = HeadWithChain();
  const Eigen::Index first = BallHead().mesh.vertices.rows();
  EditedMatch match = WholeMatch(head, false);
  for (Eigen::Index v = first; v < head.mesh.vertices.rows(); ++v) match.is_matched[size_t(v)] = false;
  match.is_matched[10] = false;  // A vertex that the mesh lost.
  for (Eigen::Index v = 0; v < first; ++v)
    if (v != 10) match.places.row(v) += Eigen::RowVector3d(0.5, 0, 1);
  const EditedHead edited = ApplyEdit(head, match);
  EXPECT_EQ(edited.num_missing, 1) << "parts that the mesh lacks do not count";
  EXPECT_EQ(edited.num_expected, first);
  const geometry::Points moves = edited.head.mesh.vertices - head.mesh.vertices;
  EXPECT_LT((moves.rowwise() - Eigen::RowVector3d(0.5, 0, 1)).cwiseAbs().maxCoeff(), 1e-9);
}

}  // namespace
}  // namespace daumier::rig
