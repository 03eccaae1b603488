#include "systems/sketch/train/parser_recipe.h"

#include "tests/support/expect_error.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"
#include "train/trainer.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

#include <memory>
#include <numeric>

namespace daumier::sketch {
namespace {

class ParserRecipeTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<testing::TempDir>();
    testing::BuildSyntheticFaces(*folder_ / "faces", 1);
    testing::BuildSyntheticSketches(*folder_ / "faces", *folder_ / "sketches");
    sketches_ = std::make_unique<datasets::SketchDatabase>(*folder_ / "sketches");
  }
  static void TearDownTestSuite() {
    sketches_.reset();
    folder_.reset();
  }

  static ParserTrainingOptions SmallOptions() {
    ParserTrainingOptions options;
    options.network = {.resolution = 64, .width = 16, .point_width = 16};
    options.trainer.batch = 4;
    return options;
  }
  static ParserRecipe SmallRecipe(const ParserTrainingOptions& options) {
    torch::manual_seed(1);
    return {options, {*sketches_}, {0, 1, 2, 3}, {0, 1, 2, 3}, torch::kCPU};
  }

  static inline std::unique_ptr<testing::TempDir> folder_;
  static inline std::unique_ptr<datasets::SketchDatabase> sketches_;
};

TEST_F(ParserRecipeTest, LearnsTheExactDrawingsOfFourFaces) {
  ParserTrainingOptions options = SmallOptions();
  options.drawings.styles.exact = 1;
  options.drawings.styles.doodles = options.drawings.styles.cartoons = 0;
  options.drawings.mirrored = 0;
  options.optimiser.learning_rate = 1e-2;
  options.optimiser.weight_decay = 0;
  options.trainer.epochs = 40;
  options.trainer.validate_every = 40;
  ParserRecipe recipe = SmallRecipe(options);
  const auto validate = [&] {
    recipe.module().eval();
    const torch::NoGradGuard no_grad;
    return recipe.Validate();
  };
  const auto before = validate();
  recipe.module().train();
  const testing::TempDir run;
  const TrainingSummary summary = train::Train(recipe, options.trainer, options.optimiser, 1, run.path());
  EXPECT_LT(summary.best, 0.6 * before.at("nme_percent"));
  EXPECT_GT(validate().at("labels_percent"), before.at("labels_percent"));
}

TEST_F(ParserRecipeTest, EpochsDifferAndRepeat) {
  const ParserRecipe recipe = SmallRecipe(SmallOptions());
  const std::vector<int> samples = {2, 0};
  const SampleBatch first = recipe.Read(samples, 0), again = recipe.Read(samples, 0), next = recipe.Read(samples, 1);
  EXPECT_EQ(first.arrays.at("pictures").shape, (std::vector<int64_t>{2, 1, 64, 64}));
  EXPECT_EQ(first.indices.at("labels").shape, (std::vector<int64_t>{2, 32, 32}));
  EXPECT_EQ(first.arrays.at("pictures").values, again.arrays.at("pictures").values);
  EXPECT_NE(first.arrays.at("pictures").values, next.arrays.at("pictures").values);
}

TEST_F(ParserRecipeTest, LossIsTheWeightedSumOfItsParts) {
  const ParserTrainingOptions options = SmallOptions();
  ParserRecipe recipe = SmallRecipe(options);
  const std::vector<int> samples = {0, 1, 2, 3};
  const train::LossTerms loss = recipe.Loss(train::ToDevice(recipe.Read(samples, 0), torch::kCPU));
  const auto part = [&](const char* name) { return loss.parts.at(name).item<double>(); };
  EXPECT_NEAR(
      loss.total.item<double>(),
      part("heat_maps") + options.loss.label_weight * part("labels") + options.loss.state_weight * part("states"),
      1e-4);
}

TEST_F(ParserRecipeTest, OneInTenFacesIsAlsoSeenFromTheSide) {
  std::vector<int> faces(8);
  std::iota(faces.begin(), faces.end(), 0);
  EXPECT_EQ(SourcesOf({*sketches_}, faces).size(), 1u);
  const auto sources = SourcesOf({*sketches_, sketches_.get()}, faces);
  ASSERT_EQ(sources.size(), 2u);
  EXPECT_EQ(sources[1].faces, std::vector<int>{0});
}

TEST_F(ParserRecipeTest, NeedsFacesOfBothKinds) {
  testing::ExpectError([] { ParserRecipe(SmallOptions(), {*sketches_}, {0}, {}, torch::kCPU); },
                       "training and validation faces");
}

}  // namespace
}  // namespace daumier::sketch
