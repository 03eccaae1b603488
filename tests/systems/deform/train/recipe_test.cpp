#include "systems/deform/train/recipe.h"

#include "tests/support/deform_networks.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_points.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

#include <memory>

namespace daumier::deform {
namespace {

class DeformRecipeTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<testing::TempDir>();
    testing::BuildSyntheticFaces(*folder_ / "faces");
    testing::BuildSyntheticPoints(*folder_ / "faces", *folder_ / "points");
  }
  static void TearDownTestSuite() { folder_.reset(); }

  DeformRecipeTest() : faces_(*folder_ / "faces"), points_(*folder_ / "points") {
    options_.network = testing::SmallDeformOptions("hypernetwork");
    options_.points.num_points = 30;
    options_.validation = {.faces = 3, .newton_steps = 2};
    split_ = datasets::MakeSplit(faces_, options_.split, options_.seed);
  }

  DeformRecipe MakeRecipe() {
    torch::manual_seed(3);
    return DeformRecipe(options_, faces_, points_, split_, torch::kCPU);
  }

  static std::unique_ptr<testing::TempDir> folder_;
  faces::FaceDatabase faces_;
  datasets::PointDatabase points_;
  DeformTrainingOptions options_;
  datasets::Split split_;
};

std::unique_ptr<testing::TempDir> DeformRecipeTest::folder_;

TEST_F(DeformRecipeTest, LossIsTheWeightedSumOfMissesAndCodes) {
  DeformRecipe recipe = MakeRecipe();
  const std::vector<int> samples = {4, 0, 7};
  const train::LossTerms loss = recipe.Loss(train::ToDevice(recipe.Read(samples, 2), torch::kCPU));
  // A second way: the points that the dataset gives, one face and one point after the other.
  const datasets::PointDataset dataset(faces_, points_, split_.train, options_.points, options_.seed);
  const train::Batch batch = train::ToDevice(dataset.Get(samples, 2), torch::kCPU);
  double squares = 0, distances = 0, code_squares = 0;
  for (int64_t i = 0; i < 3; ++i) {
    const torch::Tensor code = recipe.decoder().codes()[samples[size_t(i)]].unsqueeze(0);
    code_squares += code.square().sum().item<double>();
    for (int64_t n = 0; n < 30; ++n) {
      const auto one = [&](const torch::Tensor& numbers) { return numbers[i].slice(0, n, n + 1); };
      const torch::Tensor miss =
          recipe.decoder().network()->Deform(code, {one(batch.at("corners")), one(batch.at("weights")), one(batch.at("positions"))})[0] -
          one(batch.at("targets"));
      squares += miss.square().sum().item<double>();
      distances += miss.norm().item<double>();
    }
  }
  EXPECT_NEAR(loss.parts.at("mean_square").item<double>(), squares / (3 * 30 * 3), 1e-6);
  const double mm = faces::MillimetresPerCm(faces_.face_template()) / points_.frame().scale;
  EXPECT_NEAR(loss.parts.at("training_error_mm").item<double>(), mm * distances / (3 * 30), 1e-3);
  EXPECT_NEAR(loss.parts.at("code_square").item<double>(), code_squares / (3 * 8), 1e-9);
  EXPECT_NEAR(loss.total.item<double>(), 3e3 * squares / 270 + 1e6 * code_squares / 24, 1e-3);
}

TEST_F(DeformRecipeTest, CodesAreOnesOfTrainingFacesAlone) {
  const DeformRecipe recipe = MakeRecipe();
  EXPECT_EQ(recipe.decoder().codes().size(0), int64_t(split_.train.size()));
  EXPECT_EQ(recipe.num_samples(), int(split_.train.size()));
  EXPECT_NEAR(recipe.decoder().codes().std().item<double>(), 0.01, 0.002);
}

TEST_F(DeformRecipeTest, ValidationChangesNoWeight) {
  DeformRecipe recipe = MakeRecipe();
  std::vector<torch::Tensor> before;
  for (const torch::Tensor& parameter : recipe.module().parameters()) before.push_back(parameter.detach().clone());
  const auto values = recipe.Validate();
  EXPECT_GT(values.at("vertex_error"), 0);
  EXPECT_NEAR(values.at(recipe.metric()),
              values.at("vertex_error") * faces::MillimetresPerCm(faces_.face_template()) / points_.frame().scale,
              1e-9);
  const auto after = recipe.module().parameters();
  for (size_t i = 0; i < before.size(); ++i) {
    EXPECT_TRUE(torch::equal(before[i], after[i]));
    EXPECT_FALSE(after[i].grad().defined());
  }
  EXPECT_EQ(recipe.Validate(), recipe.Validate());
}

TEST_F(DeformRecipeTest, RefusesReducedPrecision) {
  options_.trainer.precision = "bfloat16";
  testing::ExpectError([&] { MakeRecipe(); }, "train in float32");
}

TEST_F(DeformRecipeTest, RefusesASideWithoutFaces) {
  split_.validation.clear();
  testing::ExpectError([&] { MakeRecipe(); }, "needs training and validation faces");
}

}  // namespace
}  // namespace daumier::deform
