#include "train/trainer.h"

#include <torch/utils.h>
#include "tests/train/toy_recipe.h"

namespace daumier::train {
namespace {

using namespace toy;

TEST(Trainer, LearnsAndLeavesItsFiles) {
  const testing::TempDir run;
  ToyRecipe recipe;
  TrainerOptions options = FourEpochs();
  options.epochs = 60;
  const TrainingSummary summary = Train(recipe, options, Fast(), 5, run.path());
  EXPECT_EQ(summary.steps, 180);
  EXPECT_EQ(summary.epochs, 60);
  EXPECT_EQ(summary.metric, "mean_error");
  EXPECT_LT(summary.best, 1.0);
  EXPECT_FALSE(summary.stopped_early);
  const std::string log = ReadFile(run / RunLog::kMetricsFile);
  const Json first = Json::parse(log.substr(0, log.find('\n')));
  for (const char* key :
       {"step", "epoch", "phase", "loss", "absolute", "gradient_norm", "learning_rate", "seconds", "session_seconds"})
    EXPECT_TRUE(first.contains(key)) << key;
  EXPECT_TRUE(fs::exists(run / "best" / "model.safetensors"));
}

TEST(Trainer, ShowsEveryEpochInAnotherOrderAndNoSampleTwice) {
  const testing::TempDir run;
  ToyRecipe recipe;
  Train(recipe, FourEpochs(), Fast(), 5, run.path());
  ASSERT_EQ(recipe.seen.size(), 4u * 18);
  const std::vector<int> first(recipe.seen.begin(), recipe.seen.begin() + 18);
  const std::vector<int> second(recipe.seen.begin() + 18, recipe.seen.begin() + 36);
  EXPECT_NE(first, second);
  EXPECT_EQ(std::set<int>(first.begin(), first.end()).size(), 18u);
}

TEST(Trainer, IsDeterministicInItsSeed) {
  const testing::TempDir run, again, other;
  ToyRecipe recipe, recipe_again, recipe_other;
  torch::manual_seed(9);
  Train(recipe, FourEpochs(), Fast(), 5, run.path());
  torch::manual_seed(9);
  Train(recipe_again, FourEpochs(), Fast(), 5, again.path());
  ExpectSameContent(again.path(), run.path());
  torch::manual_seed(9);
  Train(recipe_other, FourEpochs(), Fast(), 6, other.path());
  EXPECT_NE(Content(other.path()), Content(run.path()));
}

TEST(Trainer, RefusesStagesThatAreNotTheWhole) {
  const testing::TempDir run;
  ToyRecipe recipe;
  recipe.parts = {{"half", 0.5, 1}};
  testing::ExpectError([&] { Train(recipe, FourEpochs(), Fast(), 5, run.path()); }, "add up to 0.5");
}

TEST(Trainer, KeepsTheWeightsOfTheBestValidation) {
  // The measure grows worse on purpose after the second epoch.
  const testing::TempDir run;
  ToyRecipe recipe;
  tensor::NamedTensors after_second;
  recipe.before_loss = [&](int call) {
    if (call <= 6) recipe.offset = -call;
    if (call != 7) return;
    recipe.offset = 100;
    for (const auto& item : recipe.module().named_parameters())
      after_second[item.key()] = item.value().detach().clone();
  };
  EXPECT_EQ(Train(recipe, FourEpochs(), Fast(), 5, run.path()).best_epoch, 2);
  const tensor::NamedTensors best = tensor::LoadTensors(run / "best" / "model.safetensors");
  for (const auto& [name, value] : after_second) EXPECT_TRUE(torch::equal(best.at(name), value)) << name;
}

TEST(Trainer, StopsEarlyAfterItsPatience) {
  const testing::TempDir run;
  ToyRecipe recipe;
  recipe.before_loss = [&](int call) { recipe.offset = call; };
  TrainerOptions options = FourEpochs();
  options.epochs = 50;
  options.patience = 2;
  const TrainingSummary summary = Train(recipe, options, Fast(), 5, run.path());
  EXPECT_TRUE(summary.stopped_early);
  EXPECT_EQ(summary.epochs, 3);
  ToyRecipe again;
  EXPECT_TRUE(Train(again, options, Fast(), 5, run.path()).stopped_early);
  EXPECT_EQ(again.num_calls, 0);
}

TEST(Trainer, StopsAtALossThatIsNotANumberAndWritesTheBatch) {
  const testing::TempDir run;
  ToyRecipe recipe;
  recipe.before_loss = [&](int call) {
    if (call == 5) recipe.scale = std::numeric_limits<double>::quiet_NaN();
  };
  testing::ExpectError([&] { Train(recipe, FourEpochs(), Fast(), 5, run.path()); }, "loss is nan in step 5 (epoch 2)");
  const tensor::NamedTensors batch = tensor::LoadTensors(run / "nan_batch.safetensors");
  EXPECT_EQ(batch.at("inputs").sizes(), (std::vector<int64_t>{6, 3}));
  EXPECT_EQ(batch.at("epoch").item<int64_t>(), 1);
  const std::vector<int64_t> last(recipe.seen.end() - 6, recipe.seen.end());
  EXPECT_TRUE(torch::equal(batch.at("samples"), torch::tensor(last, torch::kInt64)));
}

TEST(Trainer, StopsAtAGradientThatIsNotFinite) {
  const testing::TempDir run;
  ToyRecipe recipe;
  recipe.infinite_slope = true;
  testing::ExpectError([&] { Train(recipe, FourEpochs(), Fast(), 5, run.path()); }, "nan in step 1 (epoch 1)");
}

TEST(Trainer, ClipsGradients) {
  const testing::TempDir run;
  ToyRecipe clipped;
  OptimiserOptions options = Fast();
  TrainerOptions one_step = FourEpochs();
  one_step.epochs = 1;
  one_step.batch = 20;
  options.clip_norm = 1e-9;
  options.weight_decay = 0;
  // A gradient far below AdamW's epsilon of 1e-8 hardly moves a weight.
  const torch::Tensor before = clipped.module().parameters().front().detach().clone();
  Train(clipped, one_step, options, 5, run.path());
  const double moved = (clipped.module().parameters().front().detach() - before).abs().max().item<double>();
  EXPECT_LT(moved, 0.2 * options.learning_rate);
}

TEST(Trainer, ReadsAheadOfTheStepAndEveryBatchOnce) {
  const testing::TempDir run;
  ToyRecipe recipe;
  recipe.before_loss = [&](int call) {
    while (recipe.num_reads < std::min(call + 2, 12)) std::this_thread::yield();
  };
  Train(recipe, FourEpochs(), Fast(), 5, run.path());
  EXPECT_EQ(recipe.num_reads, 12);
}

TEST(Trainer, AccumulatedBatchesEqualOneLargeBatch) {
  // Without batch norm and dropout. Six batches of 3 and three of 6 see the same samples in the same order.
  std::vector<std::vector<torch::Tensor>> weights;
  std::vector<std::vector<double>> losses;
  for (const auto& [batch, accumulate] : {std::pair{6, 1}, {3, 2}, {2, 3}}) {
    const testing::TempDir run;
    ToyRecipe recipe(1, /*plain=*/true);
    TrainerOptions options = FourEpochs();
    options.batch = batch;
    options.accumulate = accumulate;
    EXPECT_EQ(Train(recipe, options, Fast(), 5, run.path()).steps, 12);
    EXPECT_EQ(recipe.num_calls, 12 * accumulate);
    weights.push_back(recipe.module().parameters());
    losses.emplace_back();
    for (const MetricsRecord& record : ReadMetrics(run.path())) losses.back().push_back(record.line.value("loss", 0.0));
  }
  for (size_t i = 1; i < weights.size(); ++i) {
    for (size_t k = 0; k < weights[0].size(); ++k)
      EXPECT_TRUE(torch::allclose(weights[i][k], weights[0][k], 1e-5, 1e-6)) << i << " " << k;
    for (size_t k = 0; k < losses[0].size(); ++k) EXPECT_NEAR(losses[i][k], losses[0][k], 1e-5 * losses[0][k]);
  }
}

TEST(Trainer, ComputesTheLossInThePrecisionOfItsOptions) {
  for (const char* precision : {"float32", "bfloat16"}) {
    const testing::TempDir run;
    ToyRecipe recipe(1, /*plain=*/true);
    TrainerOptions options = FourEpochs();
    options.precision = precision;
    Train(recipe, options, Fast(), 5, run.path());
    for (const bool reduced : recipe.reduced) EXPECT_EQ(reduced, options.precision == "bfloat16");
    EXPECT_FALSE(tensor::Autocast::IsOn(torch::kCPU));
  }
}

TEST(Trainer, GroupsTrainAtTheirOwnRate) {
  const testing::TempDir run;
  ToyRecipe recipe;
  recipe.parameter_groups = {{.prefix = "layers.0.", .rate = 0, .weight_decay = 0}};
  const std::vector<torch::Tensor> before = [&] {
    std::vector<torch::Tensor> copies;
    for (const auto& parameter : recipe.module().parameters()) copies.push_back(parameter.detach().clone());
    return copies;
  }();
  Train(recipe, FourEpochs(), Fast(), 5, run.path());
  const auto after = recipe.module().parameters();
  EXPECT_TRUE(torch::equal(after.front(), before.front()));
  EXPECT_FALSE(torch::equal(after.back(), before.back()));
}

}  // namespace
}  // namespace daumier::train
