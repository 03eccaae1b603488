#include "faces/model_shapes.h"

#include "tests/support/expect_error.h"
#include "tests/support/synthetic_model.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

TEST(ModelShapes, ColumnHoldsKeptVerticesOneAfterTheOther) {
  geometry::Points displacement(3, 3);
  displacement << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  const Eigen::VectorXf column = ShapeColumn(displacement, geometry::MapKept({0, 2}, 3));
  EXPECT_EQ(column, (Eigen::VectorXf(6) << 1, 2, 3, 7, 8, 9).finished());
}

TEST(ModelShapes, RecipesBecomeWeightsByName) {
  const FaceModel model = testing::SyntheticModel();
  const auto expressions =
      MakeExpressions({{"neutral", {}}, {"grin", {{"smile_right", 0.5f}, {"pucker", 2.0f}}}}, model);
  ASSERT_EQ(expressions.size(), 2u);
  EXPECT_TRUE(expressions[0].weights.isZero());
  EXPECT_EQ(expressions[1].weights, (Eigen::VectorXf(7) << 0, 0, 0.5f, 0, 0, 0, 2).finished());
  testing::ExpectError([&] { MakeExpressions({{"neutral", {}}, {"growl", {{"snout", 1.0f}}}}, model); }, "'snout'");
}

TEST(ModelShapes, ChecksumNamesTheData) {
  FaceModel model = testing::SyntheticModel();
  const std::string before = ModelChecksum(model);
  EXPECT_EQ(ModelChecksum(testing::SyntheticModel()), before);
  model.expression_shapes(5, 1) += 1;
  EXPECT_NE(ModelChecksum(model), before);
}

}  // namespace
}  // namespace daumier::faces
