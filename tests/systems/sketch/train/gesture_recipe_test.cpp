#include "systems/sketch/train/gesture_recipe.h"

#include "datasets/build/gestures.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"
#include "train/trainer.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

#include <numeric>

namespace daumier::sketch {
namespace {

class GestureRecipeTest : public ::testing::Test {
 protected:
  GestureRecipeTest() { datasets::BuildGestures({.num_hands = 3, .per_gesture = 4, .none = 8}, folder_ / "gestures"); }

  GestureRecipe Recipe(const datasets::GestureSplit& split) const {
    torch::manual_seed(1);
    return {options_, datasets::GestureDatabase(folder_ / "gestures"), split, torch::kCPU};
  }
  static std::vector<int> First(int count) {
    std::vector<int> strokes(size_t(count), 0);
    std::iota(strokes.begin(), strokes.end(), 0);
    return strokes;
  }

  const testing::TempDir folder_;
  GestureTrainingOptions options_;
};

TEST_F(GestureRecipeTest, LearnsTheStrokesOfAHand) {
  options_.optimiser.weight_decay = 0;
  options_.trainer.epochs = options_.trainer.validate_every = 25;
  options_.trainer.batch = 16;
  GestureRecipe recipe = Recipe({First(48), First(48), {}});
  const testing::TempDir run;
  const TrainingSummary summary = train::Train(recipe, options_.trainer, options_.optimiser, 1, run.path());
  EXPECT_LT(summary.best, 25) << "% of 48 strokes, that were trained on, wrong";
}

TEST_F(GestureRecipeTest, LossIsTheCrossEntropyOfTheScores) {
  GestureRecipe recipe = Recipe({First(40), First(4), {}});
  const std::vector<int> samples = {0, 5, 39};
  const train::Batch batch = train::ToDevice(recipe.Read(samples, 0), torch::kCPU);
  recipe.module().eval();
  torch::nn::Sequential network(
      std::dynamic_pointer_cast<torch::nn::SequentialImpl>(recipe.module().shared_from_this()));
  const torch::Tensor probabilities = network->forward(batch.at("pictures")).softmax(1);
  double expected = 0;
  for (int64_t i = 0; i < 3; ++i)
    expected -= std::log(probabilities[i][batch.at("gestures")[i].item<int64_t>()].item<double>()) / 3;
  EXPECT_NEAR(recipe.Loss(batch).total.item<double>(), expected, 1e-5);
}

TEST_F(GestureRecipeTest, ValidationCountsWrongStrokes) {
  GestureRecipe recipe = Recipe({First(40), First(48), {}});
  recipe.module().eval();
  const torch::NoGradGuard no_grad;
  const auto values = recipe.Validate();
  EXPECT_GT(values.at("error_percent"), 50) << "before any training";
  EXPECT_LE(values.at("gesture_error_percent"), 100);
  EXPECT_TRUE(values.contains(recipe.metric()));
}

TEST_F(GestureRecipeTest, NeedsStrokesOfBothKinds) {
  testing::ExpectError([&] { Recipe({First(3), {}, {}}); }, "strokes for training and validation, here 3 and 0");
}

}  // namespace
}  // namespace daumier::sketch
