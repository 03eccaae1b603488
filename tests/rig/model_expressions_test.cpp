#include "rig/model_expressions.h"

#include "tests/rig/named_model.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::rig {
namespace {

using testing::NamedModel;
using testing::SyntheticModel;

TEST(ModelExpressions, OfStatisticalModesAreSigned) {
  faces::FaceModel model = SyntheticModel();
  EXPECT_EQ(ExpressionsOf(model).kind, CoefficientKind::kBlend);
  model.face_template.source = "flame";
  const ModelExpressions flame = ExpressionsOf(model);
  EXPECT_EQ(flame.kind, CoefficientKind::kSigned);
  EXPECT_EQ(flame.names, model.expression_shape_names);
  EXPECT_EQ(flame.shapes, model.expression_shapes);
  EXPECT_FALSE(flame.constant);
  EXPECT_FALSE(flame.has_gaze);
}

TEST(ModelExpressions, OfBfmHaveAConstantOne) {
  faces::FaceModel model = SyntheticModel();
  model.face_template.source = "bfm";
  model.expression_shape_names[0] = "mean_expression";
  const ModelExpressions bfm = ExpressionsOf(model);
  EXPECT_EQ(bfm.kind, CoefficientKind::kSigned);
  EXPECT_EQ(bfm.constant, 0);
}

TEST(ModelExpressions, HaveAGazeByItsName) {
  faces::FaceModel model = NamedModel();
  EXPECT_FALSE(ExpressionsOf(model).has_gaze);
  model.expression_shape_names[0] = "eyeLookIn_L";
  EXPECT_TRUE(ExpressionsOf(model).has_gaze);
}

TEST(ModelExpressions, OfGivenFacesAreMeansOverPersons) {
  faces::GivenFaces given{.face_template = testing::SyntheticFace(),
                          .names = {"a", "b"},
                          .groups = {"a", "b"},
                          .expressions = {"neutral", "shape_1", "shape_2"},
                          .face = {}};
  given.face = [&](int person, int expression) -> geometry::Points {
    geometry::Points face = (1 + 0.1 * person) * given.face_template.neutral;
    face.col(1).array() += expression * (person == 0 ? 1 : 3);
    return face;
  };
  const ModelExpressions mean = ExpressionsOf(given);
  EXPECT_EQ(mean.names, (std::vector<std::string>{"shape_1", "shape_2"}));
  EXPECT_NEAR(mean.shapes(1, 0), 2, 1e-5);  // y of vertex 0: (1 + 3) / 2
  EXPECT_NEAR(mean.shapes(4, 1), 4, 1e-5);
  EXPECT_NEAR(mean.shapes(0, 0), 0, 1e-5);
  given.expressions = {"neutral"};
  testing::ExpectError([&] { ExpressionsOf(given); }, "has no expressions, only neutral faces");
}

TEST(ModelExpressions, NeedExpressionsThatAreFinite) {
  faces::FaceModel model = SyntheticModel();
  model.expression_shapes(3, 1) = std::nanf("");
  testing::ExpectError([&] { ExpressionsOf(model); }, "not finite");
  model.expression_shape_names.clear();
  model.expression_shapes.resize(model.expression_shapes.rows(), 0);
  testing::ExpectError([&] { ExpressionsOf(model); }, "Use an edition with expressions");
}

}  // namespace
}  // namespace daumier::rig
