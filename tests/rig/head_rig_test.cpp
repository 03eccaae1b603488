#include "rig/head_rig.h"

#include "geometry/topology.h"
#include "rig/expression_targets.h"
#include "tests/rig/named_model.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::rig {
namespace {

class HeadRigTest : public ::testing::Test {
 protected:
  const faces::FaceModel model_ = testing::NamedModel();
  const faces::FaceTemplate& face_ = model_.face_template;
  const HeadRig rig_{face_};
  const MorphTargets targets_ = ExpressionTargets(model_).On(face_.neutral);
  const RiggedHead head_ = rig_.On(face_.neutral, targets_);
};

TEST_F(HeadRigTest, IsClosedAndSplitIntoSkinTeethAndTongue) {
  const int num_vertices = int(head_.mesh.vertices.rows());
  EXPECT_NO_THROW(geometry::CheckManifold(head_.mesh.triangles, num_vertices));
  EXPECT_TRUE(geometry::BoundaryLoops(head_.mesh.triangles, num_vertices).empty());
  EXPECT_EQ(geometry::EulerCharacteristic(head_.mesh.triangles), 2 * (1 + 3));
  std::vector<bool> used(size_t(num_vertices), false);
  for (const int v : head_.mesh.triangles.reshaped()) used[size_t(v)] = true;
  EXPECT_EQ(std::count(used.begin(), used.end(), false), 0);
  ASSERT_EQ(head_.eyes.size(), 2u);
  for (const RiggedEye& eye : head_.eyes) {
    EXPECT_TRUE(geometry::BoundaryLoops(eye.mesh.triangles, int(eye.mesh.vertices.rows())).empty());
    EXPECT_EQ(eye.materials.size(), size_t(eye.mesh.triangles.rows()));
  }
  EXPECT_LT(head_.eyes[0].centre.x(), 0);
  EXPECT_GT(head_.eyes[1].centre.x(), 0);
  EXPECT_EQ(head_.materials.size(), size_t(head_.mesh.triangles.rows()));
}

TEST_F(HeadRigTest, SharesItsAtlas) {
  const TextureSpace& space = rig_.texture_space();
  const geometry::TriangleMesh joined = JoinedMesh(head_);
  EXPECT_EQ(joined.triangles, space.triangles);
  EXPECT_EQ(space.charts.size(), size_t(space.triangles.rows()));
  EXPECT_EQ(space.materials.size(), size_t(space.triangles.rows()));
  for (Eigen::Index i = 0; i < joined.uv_triangles.size(); ++i)
    ASSERT_EQ(joined.uv.row(joined.uv_triangles.data()[i]), space.uv.row(space.uv_triangles.data()[i]));
  EXPECT_GE(space.uv.minCoeff(), 0);
  EXPECT_LE(space.uv.maxCoeff(), 1);
  EXPECT_EQ(NumOverlappingTexels(space, 512), 0);
}

TEST_F(HeadRigTest, KeepsTheFacesVerticesAndTargets) {
  EXPECT_EQ(head_.targets.names, targets_.names);
  ASSERT_EQ(head_.targets.offsets.rows(), 3 * head_.mesh.vertices.rows());
  const std::vector<int>& finished = rig_.finished_vertices();
  for (size_t i = 0; i < finished.size(); ++i) {
    if (finished[i] >= face_.num_vertices()) break;
    EXPECT_EQ(head_.mesh.vertices.row(Eigen::Index(i)), face_.neutral.row(finished[i]));
    EXPECT_LT(
        (head_.targets.offsets.middleRows(3 * Eigen::Index(i), 3) - targets_.offsets.middleRows(3 * finished[i], 3))
            .cwiseAbs()
            .maxCoeff(),
        1e-6f);
  }
}

TEST_F(HeadRigTest, EyesAreSpheresThatTurnAboutTheirCentres) {
  const auto eyeballs = rig_.Eyeballs(face_.neutral), fitted = rig_.finished().Eyeballs(face_.neutral);
  for (size_t side = 0; side < 2; ++side) {
    EXPECT_EQ(head_.eyes[side].centre, eyeballs[side].centre);
    EXPECT_EQ(eyeballs[side].radii, geometry::Vector3::Constant(fitted[side].radii.x()));
    EXPECT_NEAR(fitted[side].centre.z() - eyeballs[side].centre.z(), 0.05, 1e-12);
    const double radius = eyeballs[side].radii.x();
    for (const auto& p : head_.eyes[side].mesh.vertices.rowwise()) {
      EXPECT_GE(p.norm(), radius - 1e-9);
      EXPECT_LE(p.norm(), radius + eyeballs[side].bulge + 1e-9);
    }
  }
}

TEST_F(HeadRigTest, RefusesTargetsOfAnotherTopology) {
  testing::ExpectError([&] { rig_.On(face_.neutral, {{"a"}, Eigen::MatrixXf::Zero(6, 1)}); }, "for ");
}

}  // namespace
}  // namespace daumier::rig
