#include "rig/carry_targets.h"

#include "tests/rig/slit_sheet.h"

#include <gtest/gtest.h>

namespace daumier::rig {
namespace {

/// A template whose lower lip moves down and whose upper one up, and heads that lie on it.
class TargetsCarried : public ::testing::Test {
 protected:
  TargetsCarried() {
    template_.mesh.vertices *= 10;
    const SeamEdges& edges = template_.slits[0];
    for (size_t i = 1; i + 1 < edges.lower.size(); ++i) template_.mesh.vertices(edges.lower[i], 1) -= 0.01;
    sides_ = SidesOfTemplate(template_.mesh, template_.slits);
    opening_ = Eigen::MatrixXf::Zero(template_.mesh.vertices.size(), 2);
    for (size_t v = 0; v < sides_.size(); ++v) {
      if (sides_[v] == FaceSide::kUpperLip) opening_(3 * Eigen::Index(v) + 1, 0) = 1;
      if (sides_[v] == FaceSide::kLowerLip) opening_(3 * Eigen::Index(v) + 1, 0) = -1;
    }
  }

  Eigen::VectorXf CarriedTo(const geometry::TriangleMesh& mesh, std::vector<HeadPart> parts) const {
    const TemplateMatch match(template_.mesh, template_.slits, sides_);
    const HeadSurface head = MakeHeadSurface(mesh);
    const HeadSlits slits = FindHeadSlits(match, head);
    const Eigen::MatrixXf carried =
        OffsetsOfVertices(head, CarryTargets(match, head, {std::move(parts), {}, {}}, slits.sides, opening_));
    EXPECT_TRUE(carried.col(1).isZero(0)) << "a target that moves nothing";
    return carried.col(0);
  }

  testing::SlitSheet template_ = testing::MakeSlitSheet(32);
  std::vector<FaceSide> sides_;
  Eigen::MatrixXf opening_;
};

TEST_F(TargetsCarried, ToTheTemplateItselfAreItsOwn) {
  const Eigen::VectorXf carried = CarriedTo(template_.mesh, {HeadPart::kSkin});
  EXPECT_LT((carried - opening_.col(0)).cwiseAbs().maxCoeff(), 1e-3f);
}

TEST_F(TargetsCarried, NeverCrossASlit) {
  testing::SlitSheet other = testing::MakeSlitSheet(20);
  other.mesh.vertices *= 10;
  const SeamEdges& edges = other.slits[0];
  for (size_t i = 1; i + 1 < edges.lower.size(); ++i) other.mesh.vertices(edges.lower[i], 1) -= 0.02;
  const Eigen::VectorXf carried = CarriedTo(other.mesh, {HeadPart::kSkin});
  for (size_t i = 2; i + 2 < edges.upper.size(); ++i) {
    EXPECT_NEAR(carried[3 * edges.upper[i] + 1], 1, 0.02f);
    EXPECT_NEAR(carried[3 * edges.lower[i] + 1], -1, 0.02f);
  }
}

TEST_F(TargetsCarried, FadeBeyondTheTemplateAndWithTheDistanceOfAttachedParts) {
  geometry::TriangleMesh mesh = template_.mesh;
  const int num_vertices = int(mesh.vertices.rows());
  mesh.vertices.conservativeResize(num_vertices + 6, 3);
  mesh.vertices.bottomRows(6) << 5, 6, 0.5, 5.1, 6, 0.5, 5, 6.1, 0.5,  // Before the upper lip.
      5, 6, 4, 5.1, 6, 4, 5, 6.1, 4;                                   // Farther than 3 cm.
  mesh.triangles.conservativeResize(mesh.triangles.rows() + 2, 3);
  mesh.triangles.bottomRows(2) << num_vertices, num_vertices + 1, num_vertices + 2, num_vertices + 3, num_vertices + 4,
      num_vertices + 5;
  const Eigen::VectorXf carried = CarriedTo(mesh, {HeadPart::kSkin, HeadPart::kAttached, HeadPart::kAttached});
  EXPECT_NEAR(carried[3 * num_vertices + 1], 1, 0.02f);
  EXPECT_TRUE(carried.tail(9).isZero(0));
}

}  // namespace
}  // namespace daumier::rig
