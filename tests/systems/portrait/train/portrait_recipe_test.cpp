#include "systems/portrait/train/portrait_recipe.h"

#include "tests/support/expect_error.h"
#include "tests/systems/portrait/train/small_portrait_runs.h"
#include "train/optimiser.h"

#include <numeric>

namespace daumier::portrait {
namespace {

TEST(PortraitRecipe, OverfitsEightPortraitsThroughTheRenderer) {
  const datasets::PortraitDatabase portraits(testing::SmallPortraitFolder() / "portraits");
  ASSERT_EQ(portraits.size(), 8);
  PortraitTrainingOptions options = testing::SmallPortraitOptions();
  std::vector<int> all(8);
  std::iota(all.begin(), all.end(), 0);
  torch::manual_seed(1);
  PortraitRecipe recipe(options, testing::SyntheticMorphable(), portraits, {all, all}, torch::kCPU);
  const train::Batch batch = train::ToDevice(recipe.Read(all, 0), torch::kCPU);
  recipe.module().eval();
  const std::map<std::string, double> before = recipe.Validate();
  recipe.module().train();
  train::Optimiser optimiser(recipe.module(), {.learning_rate = 2e-3, .weight_decay = 0});
  double first = 0, last = 0;
  for (int step = 0; step < 120; ++step) {
    optimiser.ZeroGradients();
    const train::LossTerms terms = recipe.Loss(batch);
    last = terms.total.item<double>();
    if (step == 0) first = last;
    terms.total.backward();
    optimiser.Step(2e-3);
  }
  EXPECT_LT(last, 0.15 * first);
  recipe.module().eval();
  const std::map<std::string, double> after = recipe.Validate();
  EXPECT_LT(after.at("landmark_error"), 0.3 * before.at("landmark_error"));
  EXPECT_LT(after.at("vertex_error_mm"), before.at("vertex_error_mm"));
  EXPECT_LT(after.at("angle_error_degrees"), 0.5 * before.at("angle_error_degrees"));
}

TEST(PortraitRecipe, FirstStepIsTheMeanFace) {
  const datasets::PortraitDatabase portraits(testing::SmallPortraitFolder() / "portraits");
  PortraitRecipe recipe(testing::SmallPortraitOptions(), testing::SyntheticMorphable(), portraits, {{0, 1}, {2}},
                        torch::kCPU);
  const torch::Tensor x = recipe.network()->forward(torch::rand({2, 3, 64, 64}));
  EXPECT_EQ(x.slice(1, 0, 233).abs().max().item<float>(), 0);
  // The portraits are drawn about -40 cm from the origin.
  EXPECT_NEAR(x[0][238].item<float>(), -40, 12);
  EXPECT_LT(recipe.Validate().at("landmark_error"), 0.5);
}

TEST(PortraitRecipe, PicturesWithoutTruthAreMixedIn) {
  const datasets::PortraitDatabase portraits(testing::SmallPortraitFolder() / "portraits");
  PortraitTrainingOptions options = testing::SmallPortraitOptions();
  options.loss.vertices = 1;
  PortraitRecipe recipe(options, testing::SyntheticMorphable(), portraits, {{0, 1}, {2}, &portraits}, torch::kCPU);
  EXPECT_EQ(recipe.num_samples(), 2 + 8);
  const std::vector<int> samples = {0, 2};
  const SampleBatch read = recipe.Read(samples, 0);
  EXPECT_EQ(read.arrays.at("known").values, (std::vector<float>{1, 0}));
  EXPECT_EQ(read.arrays.at("vertices").row(1)[7], 0);
  // The same picture with and without truth: landmarks are the same.
  EXPECT_EQ(std::vector<float>(read.arrays.at("landmarks").row(0), read.arrays.at("landmarks").row(0) + 136),
            std::vector<float>(read.arrays.at("landmarks").row(1), read.arrays.at("landmarks").row(1) + 136));
  EXPECT_TRUE(std::isfinite(recipe.Loss(train::ToDevice(read, torch::kCPU)).total.item<double>()));
}

TEST(PortraitRecipe, RefusesEmptySets) {
  const datasets::PortraitDatabase portraits(testing::SmallPortraitFolder() / "portraits");
  testing::ExpectError(
      [&] {
        PortraitRecipe(testing::SmallPortraitOptions(), testing::SyntheticMorphable(), portraits, {{}, {2}},
                       torch::kCPU);
      },
      "a training needs training and validation portraits");
}

}  // namespace
}  // namespace daumier::portrait
