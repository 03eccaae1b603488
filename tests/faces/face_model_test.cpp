#include "faces/face_model.h"

#include "geometry/alignment.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_model.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

using testing::ExpectError;
using testing::SyntheticModel;
using Kind = IdentityControl::Kind;

/// A model whose only identity control is `control`, with as many shapes as it names.
FaceModel WithControl(const IdentityControl& control) {
  FaceModel model = SyntheticModel();
  model.identity_controls = {control};
  model.identity_shapes = model.identity_shapes.leftCols(3).eval();
  return model;
}

TEST(FaceModel, SurfaceMeshHasTheTemplatesTrianglesAndUv) {
  FaceTemplate face = testing::SyntheticFace();
  face.uv = geometry::TextureCoordinates::Random(face.num_vertices(), 2);
  face.uv_triangles = face.triangles;
  const geometry::Points moved = 2 * face.neutral;
  const geometry::TriangleMesh mesh = SurfaceMesh(face, moved);
  EXPECT_EQ(mesh.vertices, moved);
  EXPECT_EQ(mesh.triangles, face.triangles);
  EXPECT_EQ(mesh.uv, face.uv);
  EXPECT_EQ(mesh.uv_triangles, face.uv_triangles);
  ExpectError([&] { SurfaceMesh(face, geometry::Points::Zero(3, 3)); }, "a face of 3 vertices");
}

TEST(FaceModel, ScaleIs200MillimetresFromChinToHairline) {
  FaceTemplate face = testing::SyntheticFace();
  face.neutral(face.annotation.landmarks[8], 1) = -6;
  face.neutral(face.annotation.hairline_vertex, 1) = 10;
  EXPECT_DOUBLE_EQ(MillimetresPerCm(face), 12.5);
  face.neutral(face.annotation.hairline_vertex, 1) = -6;
  ExpectError([&] { MillimetresPerCm(face); }, "hairline");
}

TEST(FaceModel, GaussianWeightsHaveTheirSigma) {
  const FaceModel model = WithControl({.name = "g", .kind = Kind::kGaussian, .shapes = {1}, .sigma = 0.5});
  Rng rng(1);
  double sum = 0, squares = 0;
  constexpr int kDraws = 4000;
  for (int i = 0; i < kDraws; ++i) {
    const Eigen::VectorXf weights = DrawIdentity(model, rng, 2.0);
    EXPECT_EQ(weights[0], 0);
    sum += weights[1];
    squares += weights[1] * weights[1];
  }
  EXPECT_NEAR(sum / kDraws, 0, 0.06);
  EXPECT_NEAR(std::sqrt(squares / kDraws), 1.0, 0.05);
}

TEST(FaceModel, BipolarWeightsUseOneEndAndStayWithinOne) {
  const FaceModel model = WithControl({.name = "b", .kind = Kind::kBipolar, .shapes = {0, 2}, .sigma = 0.8});
  const FaceModel one_sided = WithControl({.name = "o", .kind = Kind::kBipolar, .shapes = {-1, 2}, .sigma = 0.8});
  Rng rng(2);
  bool minus = false, plus = false, clamped = false;
  for (int i = 0; i < 500; ++i) {
    const Eigen::VectorXf weights = DrawIdentity(model, rng);
    EXPECT_TRUE(weights[0] == 0 || weights[2] == 0);
    EXPECT_TRUE(weights.minCoeff() >= 0 && weights.maxCoeff() <= 1);
    minus |= weights[0] > 0;
    plus |= weights[2] > 0;
    clamped |= weights.maxCoeff() == 1;
    EXPECT_EQ(DrawIdentity(one_sided, rng)[0], 0);
  }
  EXPECT_TRUE(minus && plus && clamped);
}

TEST(FaceModel, SimplexWeightsSumToOneAndAreEqualWithoutSpread) {
  const FaceModel model = WithControl({.name = "s", .kind = Kind::kSimplex, .shapes = {0, 1, 2}, .sigma = 1.0});
  Rng rng(3);
  Eigen::VectorXf mean = Eigen::VectorXf::Zero(3);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::VectorXf weights = DrawIdentity(model, rng);
    EXPECT_GE(weights.minCoeff(), 0);
    EXPECT_NEAR(weights.sum(), 1, 1e-5);
    mean += weights / 2000;
  }
  EXPECT_LT((mean.array() - 1.0f / 3).abs().maxCoeff(), 0.03);
  EXPECT_LT((DrawIdentity(model, rng, 0).array() - 1.0f / 3).abs().maxCoeff(), 1e-6);
}

TEST(FaceModel, IdentityIsLinearInItsShapes) {
  const FaceModel model = SyntheticModel();
  Eigen::VectorXf weights = Eigen::VectorXf::Zero(model.identity_shapes.cols());
  EXPECT_EQ(IdentityFace(model, weights), model.face_template.neutral);
  weights[3] = 2;
  const geometry::Points face = IdentityFace(model, weights);
  const int nose = model.face_template.annotation.landmarks[30];
  EXPECT_NEAR(face(nose, 2), model.face_template.neutral(nose, 2) + 2.0 * model.identity_shapes(3 * nose + 2, 3), 1e-5);
  ExpectError([&] { IdentityFace(model, Eigen::VectorXf::Zero(2)); }, "2 identity weights");
}

TEST(FaceModel, AlignedIdentityForgetsSimilarities) {
  FaceModel model = SyntheticModel();
  model.align_identities = true;
  // The first shape becomes a growth by a tenth with a shift.
  const geometry::Points& neutral = model.face_template.neutral;
  for (int v = 0; v < neutral.rows(); ++v) {
    const geometry::Vector3 moved = 0.1 * neutral.row(v).transpose() + geometry::Vector3(1, 2, 3);
    model.identity_shapes.col(0).segment<3>(3 * v) = moved.cast<float>();
  }
  Eigen::VectorXf weights = Eigen::VectorXf::Zero(model.identity_shapes.cols());
  weights[0] = 1;
  EXPECT_LT((IdentityFace(model, weights) - neutral).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(FaceModel, NeutralExpressionMovesNothing) {
  const FaceModel model = SyntheticModel();
  EXPECT_TRUE(ExpressionOffset(model, model.expressions[0].weights).isZero());
  const Eigen::VectorXf smile = model.expressions[2].weights;
  EXPECT_TRUE(ExpressionOffset(model, 2 * smile).isApprox(2 * ExpressionOffset(model, smile)));
  ExpectError([&] { ExpressionOffset(model, Eigen::VectorXf::Zero(3)); }, "3 expression weights");
}

}  // namespace
}  // namespace daumier::faces
