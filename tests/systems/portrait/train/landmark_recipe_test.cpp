#include "systems/portrait/train/landmark_recipe.h"

#include "tests/support/drawn_portraits.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"
#include "train/trainer.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

#include <numeric>

namespace daumier::portrait {
namespace {

std::vector<int> Count(int count) {
  std::vector<int> indices(static_cast<size_t>(count));
  std::iota(indices.begin(), indices.end(), 0);
  return indices;
}

LandmarkTrainingOptions SmallOptions() {
  LandmarkTrainingOptions options;
  options.network = {.resolution = 64, .width = 8, .point_width = 16};
  options.trainer.batch = 8;
  return options;
}

LandmarkRecipe SmallRecipe(const LandmarkTrainingOptions& options, const LandmarkSource& source) {
  torch::manual_seed(1);
  return {options, source, Count(source.size()), Count(source.size()), torch::kCPU};
}

TEST(LandmarkRecipe, FitsFourDrawnPortraits) {
  const testing::DrawnPortraits portraits(4);
  LandmarkTrainingOptions options = SmallOptions();
  options.network.resolution = 32;
  options.augmentation.strength = 0;
  options.augmentation.flip = 0;
  options.views = {.negative_share = 0, .scene_share = 0};
  options.optimiser.learning_rate = 1e-2;
  options.optimiser.weight_decay = 0;
  options.trainer.batch = 4;
  options.trainer.epochs = 40;
  options.trainer.validate_every = 40;
  LandmarkRecipe recipe = SmallRecipe(options, portraits);
  const auto validate = [&] {
    recipe.module().eval();
    const torch::NoGradGuard no_grad;
    return recipe.Validate();
  };
  const auto before = validate();
  recipe.module().train();
  const testing::TempDir run;
  const TrainingSummary summary = train::Train(recipe, options.trainer, options.optimiser, 1, run.path());
  EXPECT_LT(summary.best, 0.4 * before.at("nme_percent"));  // A cell is 22 percent of the distance of the eyes.
  const auto after = validate();
  EXPECT_GT(after.at("mean_iou_percent"), 10 + before.at("mean_iou_percent"));
  EXPECT_LT(after.at("state_errors_percent"), 0.5 * before.at("state_errors_percent"));
}

TEST(LandmarkRecipe, ReadsTheSameViewsOfAnEpochAgainAndOthersOfTheNext) {
  const testing::DrawnPortraits portraits(6);
  const LandmarkRecipe recipe = SmallRecipe(SmallOptions(), portraits);
  const std::vector<int> samples = {4, 1, 2, 0};
  const SampleBatch first = recipe.Read(samples, 0), again = recipe.Read(samples, 0), next = recipe.Read(samples, 1);
  EXPECT_EQ(first.arrays.at("pictures").shape, (std::vector<int64_t>{5, 3, 64, 64}));  // Four crops, one scene.
  EXPECT_EQ(first.arrays.at("score").shape, (std::vector<int64_t>{5, 8, 8}));
  EXPECT_EQ(first.arrays.at("pictures").values, again.arrays.at("pictures").values);
  EXPECT_EQ(first.indices.at("labels").values, again.indices.at("labels").values);
  EXPECT_NE(first.arrays.at("pictures").values, next.arrays.at("pictures").values);
  for (const float value : first.arrays.at("pictures").values) ASSERT_TRUE(value >= 0 && value <= 1);
}

TEST(LandmarkRecipe, LossIsAFiniteSumOfItsParts) {
  const testing::DrawnPortraits portraits(4);
  const LandmarkTrainingOptions options = SmallOptions();
  LandmarkRecipe recipe = SmallRecipe(options, portraits);
  const train::LossTerms loss = recipe.Loss(train::ToDevice(recipe.Read(Count(4), 0), torch::kCPU));
  const auto part = [&](const char* name) { return loss.parts.at(name).item<double>(); };
  EXPECT_NEAR(loss.total.item<double>(),
              part("heat_maps") + options.loss.label_weight * part("labels") +
                  options.loss.state_weight * part("states") + options.loss.score_weight * part("box_score") +
                  options.loss.box_weight * part("box_size"),
              1e-4);
  loss.total.backward();
  for (const torch::Tensor& parameter : recipe.module().parameters()) {
    ASSERT_TRUE(parameter.grad().defined());
    EXPECT_TRUE(parameter.grad().isfinite().all().item<bool>());
  }
}

TEST(LandmarkRecipe, RefusesATrainingWithoutValidation) {
  const testing::DrawnPortraits portraits(4);
  testing::ExpectError([&] { LandmarkRecipe(SmallOptions(), portraits, Count(4), {}, torch::kCPU); },
                       "a training needs training and validation portraits, here 4 and 0");
}

}  // namespace
}  // namespace daumier::portrait
