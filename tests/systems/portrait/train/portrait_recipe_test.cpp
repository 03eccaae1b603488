#include "systems/portrait/train/portrait_recipe.h"

#include <torch/utils.h>
#include "systems/portrait/train/portrait_prediction.h"
#include "tests/support/expect_error.h"
#include "tests/support/small_portraits.h"
#include "tests/support/temp_dir.h"
#include "train/optimiser.h"

#include <numeric>

namespace daumier::portrait {
namespace {

class PortraitRecipeTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new testing::TempDir;
    testing::BuildSyntheticFaces(*folder_ / "faces", 4);
    testing::WriteSmallPortraits(*folder_ / "faces", *folder_ / "portraits", 2);
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }

  static PortraitTrainingOptions SmallOptions() {
    PortraitTrainingOptions options;
    options.network = {.depth = 18, .resolution = 64, .width = 8};
    options.pictures.crop = "none";
    options.pictures.shift = options.pictures.scale = options.pictures.rotation = options.pictures.colour = 0;
    return options;
  }

  static testing::TempDir* folder_;
};
testing::TempDir* PortraitRecipeTest::folder_ = nullptr;

TEST_F(PortraitRecipeTest, OverfitsEightPortraitsThroughTheRenderer) {
  const datasets::PortraitDatabase portraits(*folder_ / "portraits");
  ASSERT_EQ(portraits.size(), 8);
  PortraitTrainingOptions options = SmallOptions();
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

TEST_F(PortraitRecipeTest, FirstStepIsTheMeanFace) {
  const datasets::PortraitDatabase portraits(*folder_ / "portraits");
  PortraitRecipe recipe(SmallOptions(), testing::SyntheticMorphable(), portraits, {{0, 1}, {2}}, torch::kCPU);
  const torch::Tensor x = recipe.network()->forward(torch::rand({2, 3, 64, 64}));
  EXPECT_EQ(x.slice(1, 0, 233).abs().max().item<float>(), 0);
  // The portraits are drawn about -40 cm from the origin.
  EXPECT_NEAR(x[0][238].item<float>(), -40, 12);
  EXPECT_LT(recipe.Validate().at("landmark_error"), 0.5);
}

TEST_F(PortraitRecipeTest, SamplesAreTheDatabasesPortraitsInTheirCrops) {
  const datasets::PortraitDatabase portraits(*folder_ / "portraits");
  PortraitTrainingOptions options = SmallOptions();
  const CropSamples plain(portraits, {3, 5}, nullptr, options, Jitter::kNone, {true, true});
  const std::vector<int> both = {0, 1};
  const SampleBatch batch = plain.Get(both, 0);
  const std::vector<float> landmarks = portraits.landmarks(5);
  for (size_t k = 0; k < 136; ++k) EXPECT_NEAR(batch.arrays.at("landmarks").row(1)[k], landmarks[k], 1e-3);
  EXPECT_EQ(batch.arrays.at("known").values, (std::vector<float>{1, 1}));
  for (size_t k = 0; k < 3; ++k) EXPECT_NEAR(batch.arrays.at("angles").row(0)[k], portraits.pose(3)[k], 1e-5);
  EXPECT_NEAR(batch.arrays.at("vertices").row(1)[4], portraits.vertices(5)(1, 1), 1e-5);
  EXPECT_EQ(batch.arrays.at("input").shape, (std::vector<int64_t>{2, 3, 64, 64}));
  EXPECT_EQ(batch.arrays.at("picture").shape, (std::vector<int64_t>{2, 3, 224, 224}));
  options.pictures.crop = "landmarks";
  options.pictures.shift = 10;
  const CropSamples jittered(portraits, {3, 5}, nullptr, options, Jitter::kRandom, {true, false});
  const SampleBatch first = jittered.Get(both, 0), again = jittered.Get(both, 0), next = jittered.Get(both, 1);
  EXPECT_EQ(first.arrays.at("input").values, again.arrays.at("input").values);
  EXPECT_NE(first.arrays.at("input").values, next.arrays.at("input").values);
}

TEST_F(PortraitRecipeTest, PicturesWithoutTruthAreMixedIn) {
  const datasets::PortraitDatabase portraits(*folder_ / "portraits");
  PortraitTrainingOptions options = SmallOptions();
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

TEST_F(PortraitRecipeTest, RefusesEmptySets) {
  const datasets::PortraitDatabase portraits(*folder_ / "portraits");
  testing::ExpectError(
      [&] {
        PortraitRecipe(SmallOptions(), testing::SyntheticMorphable(), portraits, {{}, {2}}, torch::kCPU);
      },
      "a training needs training and validation portraits");
}

}  // namespace
}  // namespace daumier::portrait
