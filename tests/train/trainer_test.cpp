#include "train/trainer.h"

#include "core/files.h"
#include "core/interrupt.h"
#include "core/json.h"
#include "tensor/tensor_file.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"
#include "train/event_file.h"
#include "train/run_log.h"

#include <gtest/gtest.h>
#include <torch/nn/module.h>
#include <torch/nn/modules/activation.h>
#include <torch/nn/modules/batchnorm.h>
#include <torch/nn/modules/container/sequential.h>
#include <torch/nn/modules/dropout.h>
#include <torch/nn/modules/linear.h>
#include <torch/nn/pimpl.h>
#include <torch/utils.h>

#include <functional>
#include <limits>
#include <set>
#include <sstream>

namespace daumier::train {
namespace {

namespace fs = std::filesystem;

struct NetworkImpl : torch::nn::Module {
  NetworkImpl() {
    layers = register_module(
        "layers", torch::nn::Sequential(torch::nn::Linear(3, 8), torch::nn::BatchNorm1d(8), torch::nn::ReLU(),
                                        torch::nn::Dropout(0.2), torch::nn::Linear(8, 1)));
  }
  torch::nn::Sequential layers{nullptr};
};
TORCH_MODULE(Network);

/// Learns y = x0 - 2 x1 from 26 samples by a network whose dropout draws from LibTorch's generator.
class ToyRecipe : public Recipe {
 public:
  explicit ToyRecipe(uint64_t seed = 1) {
    torch::manual_seed(seed);
    network_ = Network();
    torch::manual_seed(77);
    inputs_ = torch::randn({26, 3});
    targets_ = inputs_.select(1, 0) - 2 * inputs_.select(1, 1);
  }

  torch::nn::Module& module() override { return *network_; }
  torch::Device device() const override { return torch::kCPU; }
  int num_samples() const override { return 20; }
  LossTerms Loss(const std::vector<int>& samples, int64_t epoch) override {
    ++num_calls;
    epochs.push_back(epoch);
    seen.insert(seen.end(), samples.begin(), samples.end());
    if (before_loss) before_loss(num_calls);
    const torch::Tensor index = torch::tensor(samples, torch::kInt64);
    const torch::Tensor error =
        network_->layers->forward(inputs_.index_select(0, index)).squeeze(1) - targets_.index_select(0, index);
    return {error.square().mean() * scale, {{"absolute", error.abs().mean()}}};
  }
  std::map<std::string, double> Validate() override {
    EXPECT_FALSE(network_->is_training());
    const torch::Tensor error = network_->layers->forward(inputs_.slice(0, 20)).squeeze(1) - targets_.slice(0, 20);
    return {{"mean_error", error.abs().mean().item<double>() + offset}};
  }
  std::string metric() const override { return "mean_error"; }
  std::vector<Stage> stages() const override { return parts; }
  void EnterStage(int stage) override { entered.emplace_back(stage, num_calls); }
  tensor::NamedTensors BatchTensors(const std::vector<int>& samples, int64_t epoch) override {
    return {{"inputs", inputs_.index_select(0, torch::tensor(samples, torch::kInt64))},
            {"epoch", torch::tensor({epoch}, torch::kInt64)}};
  }

  std::function<void(int call)> before_loss;
  std::vector<int> seen;
  std::vector<int64_t> epochs;
  std::vector<Stage> parts{{"", 1, 1}};
  std::vector<std::pair<int, int>> entered;  ///< Stage, and the calls of Loss before it.
  int num_calls = 0;
  double scale = 1, offset = 0;

 private:
  Network network_{nullptr};
  torch::Tensor inputs_, targets_;
};

/// Three steps an epoch of 20 samples, two left over.
TrainerOptions FourEpochs() {
  TrainerOptions options;
  options.epochs = 4;
  options.batch = 6;
  options.log_every = 2;
  return options;
}

OptimiserOptions Fast() {
  OptimiserOptions options;
  options.learning_rate = 0.02;
  return options;
}

/// The run's files without what holds a clock.
std::map<std::string, std::string> Content(const fs::path& run) {
  std::map<std::string, std::string> content;
  for (const char* file :
       {"best/model.safetensors", "checkpoints/latest/model.safetensors", "checkpoints/latest/optimiser.safetensors",
        "checkpoints/latest/random.safetensors", "checkpoints/latest/state.json"})
    content[file] = ReadFile(run / file);
  std::istringstream lines(ReadFile(run / RunLog::kMetricsFile));
  for (std::string line; std::getline(lines, line);) {
    Json entry = Json::parse(line);
    entry.erase("seconds");
    content[RunLog::kMetricsFile] += entry.dump() + "\n";
  }
  for (const ScalarEvent& event : ReadEvents(run / RunLog::kEventFile))
    content["events"] += fmt::format("{} {} {}\n", event.step, event.tag, event.value);
  return content;
}

void ExpectSameContent(const fs::path& run, const fs::path& other) {
  const auto content = Content(run), expected = Content(other);
  for (const auto& [name, bytes] : expected) EXPECT_EQ(content.at(name), bytes) << name;
}

struct Stopped {};

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
  for (const char* key : {"step", "epoch", "phase", "loss", "absolute", "gradient_norm", "learning_rate", "seconds"})
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

TEST(Trainer, TellsTheEpochOfEachStepAfterResumingToo) {
  const testing::TempDir run;
  ToyRecipe recipe, resumed;
  recipe.before_loss = [](int call) {
    if (call == 8) throw Stopped();
  };
  EXPECT_THROW(Train(recipe, FourEpochs(), Fast(), 5, run.path()), Stopped);
  EXPECT_EQ(recipe.epochs, (std::vector<int64_t>{0, 0, 0, 1, 1, 1, 2, 2}));
  Train(resumed, FourEpochs(), Fast(), 5, run.path());
  EXPECT_EQ(resumed.epochs, (std::vector<int64_t>{2, 2, 2, 3, 3, 3}));
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

/// Kills a training in the given step, perhaps with checkpoints amid epochs, and goes on with a network of other
/// weights.
void ExpectResumedEqualsUninterrupted(int killed_in_step, int checkpoint_every,
                                      const std::vector<Stage>& stages = {{"", 1, 1}}) {
  TrainerOptions options = FourEpochs();
  options.checkpoint_every = checkpoint_every;
  const testing::TempDir whole, killed;
  ToyRecipe uninterrupted;
  uninterrupted.parts = stages;
  torch::manual_seed(9);
  Train(uninterrupted, options, Fast(), 5, whole.path());

  ToyRecipe first;
  first.parts = stages;
  first.before_loss = [&](int call) {
    if (call == killed_in_step) throw Stopped();
  };
  torch::manual_seed(9);
  EXPECT_THROW(Train(first, options, Fast(), 5, killed.path()), Stopped);
  ToyRecipe second;
  second.parts = stages;
  torch::manual_seed(9);
  const TrainingSummary summary = Train(second, options, Fast(), 5, killed.path());
  EXPECT_EQ(summary.steps, 12);
  ExpectSameContent(killed.path(), whole.path());
}

TEST(Trainer, ResumedEqualsUninterruptedBeforeTheFirstCheckpoint) {
  ExpectResumedEqualsUninterrupted(3, 0);
}
TEST(Trainer, ResumedEqualsUninterruptedAtAnEpochBorder) {
  ExpectResumedEqualsUninterrupted(7, 0);
}
TEST(Trainer, ResumedEqualsUninterruptedAmidAnEpoch) {
  ExpectResumedEqualsUninterrupted(9, 0);
}
TEST(Trainer, ResumedEqualsUninterruptedFromACheckpointAmidAnEpoch) {
  ExpectResumedEqualsUninterrupted(6, 1);
}

/// 12 steps in all: none in the first stage, then 6 and 6.
const std::vector<Stage> kStages{{"none", 0, 1}, {"one", 0.5, 0.1}, {"two", 0.5, 1}};

TEST(Trainer, EntersItsStagesOneAfterTheOtherEachWithItsOwnRates) {
  const testing::TempDir run;
  ToyRecipe recipe;
  recipe.parts = kStages;
  TrainerOptions options = FourEpochs();
  options.log_every = 1;
  Train(recipe, options, Fast(), 5, run.path());
  EXPECT_EQ(recipe.entered, (std::vector<std::pair<int, int>>{{0, 0}, {1, 0}, {2, 6}}));
  std::vector<double> rates;
  std::istringstream lines(ReadFile(run / RunLog::kMetricsFile));
  for (std::string line; std::getline(lines, line);) {
    const Json entry = Json::parse(line);
    if (entry.at("phase") == "train") rates.push_back(entry.at("learning_rate"));
  }
  ASSERT_EQ(rates.size(), 12u);
  for (int step = 0; step < 12; ++step)
    EXPECT_NEAR(rates[size_t(step)], (step < 6 ? 0.1 : 1) * LearningRate(Fast(), step % 6, 6), 1e-9) << step;
}

TEST(Trainer, ResumedEqualsUninterruptedWithinAndBetweenStages) {
  for (const int killed_in_step : {4, 7, 8, 11}) {
    SCOPED_TRACE(killed_in_step);
    ExpectResumedEqualsUninterrupted(killed_in_step, 0, kStages);
  }
  ExpectResumedEqualsUninterrupted(7, 1, kStages);
}

TEST(Trainer, RefusesStagesThatAreNotTheWhole) {
  const testing::TempDir run;
  ToyRecipe recipe;
  recipe.parts = {{"half", 0.5, 1}};
  testing::ExpectError([&] { Train(recipe, FourEpochs(), Fast(), 5, run.path()); }, "add up to 0.5");
}

TEST(Trainer, SavesOnAnInterruptSaysHowToGoOnAndEndsWithTheSameBytes) {
  const testing::TempDir whole, stopped;
  ToyRecipe uninterrupted;
  torch::manual_seed(9);
  Train(uninterrupted, FourEpochs(), Fast(), 5, whole.path());

  ToyRecipe first;
  first.before_loss = [&](int call) { SetInterrupted(call == 5); };
  torch::manual_seed(9);
  testing::ExpectError(
      [&] { Train(first, FourEpochs(), Fast(), 5, stopped.path()); },
      fmt::format("stopped after step 5 of 12 and is saved; go on with: daumier train CONFIG --out {} --resume",
                  stopped.path().string()));
  SetInterrupted(false);
  ToyRecipe second(2);
  Train(second, FourEpochs(), Fast(), 5, stopped.path());
  EXPECT_EQ(second.num_calls, 7);
  ExpectSameContent(stopped.path(), whole.path());
}

TEST(Trainer, OfAFinishedRunDoesNothing) {
  const testing::TempDir run;
  ToyRecipe recipe, again;
  const TrainingSummary summary = Train(recipe, FourEpochs(), Fast(), 5, run.path());
  const TrainingSummary summary_again = Train(again, FourEpochs(), Fast(), 5, run.path());
  EXPECT_EQ(again.num_calls, 0);
  EXPECT_EQ(summary_again.best, summary.best);
  EXPECT_EQ(summary_again.best_epoch, summary.best_epoch);
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
  const std::vector<int> last(recipe.seen.end() - 6, recipe.seen.end());
  EXPECT_TRUE(torch::equal(batch.at("samples"), torch::tensor(last, torch::kInt32)));
}

TEST(Trainer, StopsAtAGradientThatIsNotFinite) {
  const testing::TempDir run;
  ToyRecipe recipe;
  recipe.before_loss = [&](int) { recipe.scale = 1e30; };
  testing::ExpectError([&] { Train(recipe, FourEpochs(), Fast(), 5, run.path()); },
                       "gradient is inf in step 1 (epoch 1)");
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

}  // namespace
}  // namespace daumier::train
