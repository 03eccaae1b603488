#include "systems/expression/train/recipe.h"

#include "tensor/array.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

#include <cmath>

namespace daumier::expression {
namespace {

TEST(ExpressionRecipe, WithoutWeightsTheLossIsTheLogarithmOfTheNumberOfExpressions) {
  const testing::TempDir folder;
  testing::BuildSyntheticFaces(folder / "faces");
  const faces::FaceDatabase faces(folder / "faces");
  ExpressionRecipe recipe({}, faces, datasets::MakeSplit(faces, {}, 1), torch::kCPU);
  {
    const at::NoGradGuard no_grad;
    for (torch::Tensor& parameter : recipe.module().parameters()) parameter.zero_();
  }
  const std::vector<int> samples = {0, 5, 2};
  const train::LossTerms terms = recipe.Loss(train::ToDevice(recipe.Read(samples, 0), torch::kCPU));
  EXPECT_NEAR(terms.total.item<double>(), std::log(4.0), 1e-6);
  // All scores are equal, the first of them counts: of 4 expressions 3 are wrong.
  EXPECT_DOUBLE_EQ(recipe.Validate().at("error_percent"), 75);
}

TEST(ReadFaces, LabelsAFaceByItsExpression) {
  const testing::TempDir folder;
  testing::BuildSyntheticFaces(folder / "faces");
  const faces::FaceDatabase faces(folder / "faces");
  const std::vector<int> indices = {2, faces.index({1, 0, 3})};
  const SampleBatch batch = ReadFaces(faces, indices);
  EXPECT_EQ(batch.indices.at("expressions").values, (std::vector<int64_t>{2, 3}));
  EXPECT_EQ(batch.arrays.at("vertices").row(1)[4], faces.vertices(indices[1])[4]);
}

}  // namespace
}  // namespace daumier::expression
