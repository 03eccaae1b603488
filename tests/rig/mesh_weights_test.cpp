#include "rig/mesh_weights.h"

#include "faces/face_model_file.h"
#include "geometry/normals.h"
#include "rig/arkit_names.h"
#include "rig/expression_targets.h"
#include "tests/rig/random_targets.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace daumier::rig {
namespace {

/// A person of the shipped model with targets, and expressions of this head.
class MeshWeightsOfHeads : public ::testing::Test {
 protected:
  struct Person {
    geometry::Points rest;
    MorphTargets targets;
    WeightSolver solver;
  };
  static const Person& ThePerson() {
    static const Person person = [] {
      const faces::FaceModel model = faces::ReadFaceModel(testing::SourceRoot() / "weights/face-ict");
      Rng rng(1);
      const geometry::Points rest = faces::IdentityFace(model, faces::DrawIdentity(model, rng));
      MorphTargets targets = ExpressionTargets(model).On(rest);
      const Eigen::VectorXd areas = geometry::VertexAreas({rest, model.face_template.triangles});
      WeightSolver solver(targets, areas, MostWeights(1, GazeTargets::kUsed));
      return Person{rest, std::move(targets), std::move(solver)};
    }();
    return person;
  }
  static geometry::Points Shown(const Eigen::VectorXd& weights) {
    const Eigen::VectorXd offset = ThePerson().targets.offsets.cast<double>() * weights;
    return ThePerson().rest + Eigen::Map<const geometry::Points>(offset.data(), offset.size() / 3, 3);
  }
};

TEST_F(MeshWeightsOfHeads, AreThoseOfTheBlend) {
  Rng rng(2);
  for (int i = 0; i < 5; ++i) {
    const Eigen::VectorXd weights = testing::RandomWeights(rng);
    const MeshWeights solved = WeightsOfMesh(ThePerson().solver, ThePerson().rest, Shown(weights));
    EXPECT_LT((solved.weights - weights).cwiseAbs().maxCoeff(), 1e-5);
    EXPECT_LT(solved.error.greatest_cm, 1e-5);
    EXPECT_GT(solved.at_rest.rms_cm, 0.01);
  }
}

TEST_F(MeshWeightsOfHeads, DoNotDependOnWhereTheHeadIs) {
  Rng rng(3);
  const Eigen::VectorXd weights = testing::RandomWeights(rng);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, geometry::Vector3(1, -2, 0.5).normalized()).toRotationMatrix();
  const geometry::Vector3 shift(10, -4, 30);
  const geometry::Points moved = (Shown(weights) * turn.transpose()).rowwise() + shift.transpose();
  const MeshWeights solved = WeightsOfMesh(ThePerson().solver, ThePerson().rest, moved);
  EXPECT_LT((solved.weights - weights).cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_LT((solved.rotation - turn).norm(), 1e-6);
  EXPECT_LT((solved.translation - shift).norm(), 1e-4);
}

TEST_F(MeshWeightsOfHeads, OfTheHeadAtRestAreZero) {
  const MeshWeights solved = WeightsOfMesh(ThePerson().solver, ThePerson().rest, ThePerson().rest);
  EXPECT_LT(solved.weights.maxCoeff(), 1e-9);
  EXPECT_LT(solved.error.rms_cm, 1e-9);
}

TEST_F(MeshWeightsOfHeads, AreNearThoseOfANoisyMesh) {
  Rng rng(4);
  const Eigen::VectorXd weights = testing::RandomWeights(rng);
  geometry::Points mesh = Shown(weights);
  for (double& x : mesh.reshaped()) x += 0.02 * rng.Normal();  // 0.2 mm a coordinate.
  const MeshWeights solved = WeightsOfMesh(ThePerson().solver, ThePerson().rest, mesh);
  EXPECT_LT((solved.weights - weights).cwiseAbs().maxCoeff(), 0.05);
  EXPECT_NEAR(solved.error.rms_cm, 0.02 * std::sqrt(3.0), 0.004);
}

TEST_F(MeshWeightsOfHeads, NeedTheSameVertices) {
  testing::ExpectError([] { WeightsOfMesh(ThePerson().solver, ThePerson().rest, ThePerson().rest.topRows(5)); },
                       "the mesh has 5 vertices");
}

}  // namespace
}  // namespace daumier::rig
