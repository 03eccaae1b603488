#include "faces/import/linear_model.h"

#include "tests/faces/import/foreign_face.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

using testing::ForeignMesh;

/// Two identity shapes and one expression shape, in decimetres: shape s moves vertex v by (s + 1, 0, v).
LinearFile SmallFile() {
  LinearFile file;
  file.source = "linear";
  file.mean = ForeignMesh(0, 10);
  const Eigen::Index num_vertices = file.mean.vertices.rows();
  const auto shape = [&](int s) {
    Eigen::VectorXf column = Eigen::VectorXf::Zero(3 * num_vertices);
    for (Eigen::Index v = 0; v < num_vertices; ++v) column.segment<3>(3 * v) << s + 1.0f, 0, static_cast<float>(v);
    return column;
  };
  file.identity_shapes.resize(3 * num_vertices, 2);
  file.identity_shapes << shape(0), shape(1);
  file.expression_shapes = shape(2);
  file.expression_shape_names = {"open"};
  file.expressions = ExpressionsOfModes(file.expression_shape_names);
  file.cm_per_unit = 10;
  file.provenance = {{"name", "linear"}, {"version", "1"}, {"checksum", ""}, {"licence", "mine"}};
  return file;
}

TEST(LinearModel, IsScaledAndAnnotated) {
  const FaceModel model = ImportLinearModel(SmallFile(), testing::ForeignAnnotation());
  EXPECT_LT((model.face_template.neutral - ForeignMesh().vertices).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_EQ(model.identity_shapes(3 * 7 + 0, 1), 20);
  EXPECT_EQ(model.expression_shapes(3 * 7 + 2, 0), 70);
  EXPECT_EQ(model.face_template.annotation.landmarks, testing::SyntheticFace().annotation.landmarks);
  EXPECT_EQ(model.face_template.provenance.at("licence"), "mine");
  EXPECT_EQ(model.face_template.provenance.at("checksum").get<std::string>().size(), 64u);
}

TEST(LinearModel, IdentityWeightsAreStandardNormal) {
  const FaceModel model = ImportLinearModel(SmallFile(), testing::ForeignAnnotation());
  ASSERT_EQ(model.identity_controls.size(), 2u);
  Rng rng(3);
  double sum = 0, squares = 0;
  constexpr int kDraws = 4000;
  for (int i = 0; i < kDraws; ++i) {
    const double weight = DrawIdentity(model, rng)[1];
    sum += weight / kDraws;
    squares += weight * weight / kDraws;
  }
  EXPECT_NEAR(sum, 0, 0.05);
  EXPECT_NEAR(squares, 1, 0.07);
}

TEST(LinearModel, ShapesAreCroppedLikeTheMean) {
  AnnotationFile file = testing::ForeignAnnotation(false);
  const auto& grid = testing::ForeignGrid();
  WaypointLoop neck{.name = "neck", .waypoints = {}, .mirror_of = {}};
  for (int i = 1 - testing::SyntheticGrid::kHalf; i <= testing::SyntheticGrid::kHalf; ++i)
    neck.waypoints.push_back(grid.at(i, 1));
  file.cuts = {neck};
  file.crop_seed = grid.at(0, 15);
  const FaceModel model = ImportLinearModel(SmallFile(), file);
  constexpr int kCut = 2 * testing::SyntheticGrid::kHalf;
  EXPECT_EQ(model.identity_shapes.rows(), 3 * (grid.mesh().vertices.rows() - kCut));
  EXPECT_EQ(model.identity_shapes(2, 0), 10 * kCut);
}

TEST(LinearModel, ModesWithoutNamesAreExpressionsOfBothSides) {
  const auto expressions = ExpressionsOfModes({"mean", "a", "b"}, 1);
  ASSERT_EQ(expressions.size(), 5u);
  EXPECT_EQ(expressions[0].name, "neutral");
  EXPECT_TRUE(expressions[0].weights.isZero());
  EXPECT_EQ(expressions[2].name, "a_minus");
  EXPECT_EQ(expressions[2].weights, Eigen::Vector3f(1, -2, 0));
  EXPECT_EQ(expressions[3].weights, Eigen::Vector3f(1, 0, 2));
  EXPECT_EQ(ExpressionsOfModes(NumberedShapes("mode", 100, 0)).size(), 25u);
}

}  // namespace
}  // namespace daumier::faces
