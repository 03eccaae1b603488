// Trainings that are stopped and resumed.
#include <torch/utils.h>
#include "tests/train/toy_recipe.h"
#include "train/trainer.h"

namespace daumier::train {
namespace {

using namespace toy;

TEST(Trainer, PassesTheEpochOfEachStepAlsoAfterResuming) {
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

/// Kills a training in the given step, perhaps with checkpoints amid epochs, and resumes with a network of other
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

TEST(Trainer, SavesOnAnInterruptPrintsTheResumeCommandAndEndsWithTheSameBytes) {
  const testing::TempDir whole, stopped;
  ToyRecipe uninterrupted;
  torch::manual_seed(9);
  Train(uninterrupted, FourEpochs(), Fast(), 5, whole.path());

  ToyRecipe first;
  std::stop_source stop;
  first.before_loss = [&](int call) {
    if (call == 5) stop.request_stop();
  };
  torch::manual_seed(9);
  testing::ExpectError(
      [&] { Train(first, FourEpochs(), Fast(), 5, stopped.path(), Task(stop.get_token())); },
      fmt::format(
          "interrupted at step 5 of 12; checkpoint saved. Resume with: daumier train {0}/resolved.toml --out {0} "
          "--resume",
          stopped.path().string()));
  ToyRecipe second(2);
  Train(second, FourEpochs(), Fast(), 5, stopped.path());
  EXPECT_EQ(second.num_calls, 7);
  ExpectSameContent(stopped.path(), whole.path());
}

TEST(Trainer, CountsTheStepsOfTheWholeTrainingAlsoAfterResuming) {
  const testing::TempDir run;
  ToyRecipe recipe, resumed, longer;
  recipe.before_loss = [](int call) {
    if (call == 8) throw Stopped();
  };
  EXPECT_THROW(Train(recipe, FourEpochs(), Fast(), 5, run.path()), Stopped);
  std::vector<std::pair<int64_t, int64_t>> counts;
  const Task task({}, [&](const TaskProgress& report) { counts.emplace_back(report.done, report.total); });
  Train(resumed, FourEpochs(), Fast(), 5, run.path(), task);
  EXPECT_EQ(counts.front(), std::pair(int64_t{6}, int64_t{12})) << "the checkpoint of the second epoch";
  EXPECT_EQ(counts.back(), std::pair(int64_t{12}, int64_t{12}));
  counts.clear();
  TrainerOptions six = FourEpochs();
  six.epochs = 6;
  Train(longer, six, Fast(), 5, run.path(), task, {{4, 4}});
  EXPECT_EQ(counts.front(), std::pair(int64_t{12}, int64_t{18}));
  EXPECT_EQ(counts.back(), std::pair(int64_t{18}, int64_t{18}));
}

TEST(Trainer, OfAFinishedRunDoesNothing) {
  const testing::TempDir run;
  ToyRecipe recipe, again;
  const TrainingSummary summary = Train(recipe, FourEpochs(), Fast(), 5, run.path());
  const fs::file_time_type long_ago{};
  for (const auto& entry : fs::recursive_directory_iterator(run.path())) fs::last_write_time(entry.path(), long_ago);
  std::stop_source stop;
  stop.request_stop();
  int num_reports = 0;
  const Task task(stop.get_token(), [&](const TaskProgress&) { ++num_reports; });
  const TrainingSummary summary_again = Train(again, FourEpochs(), Fast(), 5, run.path(), task);
  for (const auto& entry : fs::recursive_directory_iterator(run.path()))
    EXPECT_EQ(fs::last_write_time(entry.path()), long_ago) << entry.path();
  EXPECT_EQ(num_reports, 0) << "0 of 0 steps";
  EXPECT_GT(summary_again.seconds, 0);
  EXPECT_LE(summary_again.seconds, summary.seconds) << "until the last checkpoint";
  EXPECT_EQ(again.num_calls, 0);
  EXPECT_EQ(summary_again.best, summary.best);
  EXPECT_EQ(summary_again.best_epoch, summary.best_epoch);
}

TrainerOptions Epochs(int epochs) {
  TrainerOptions options = FourEpochs();
  options.epochs = epochs;
  return options;
}

/// The rate of each step from the log.
std::vector<double> RatesOf(const std::filesystem::path& run) {
  std::vector<double> rates;
  std::istringstream lines(ReadFile(run / RunLog::kMetricsFile));
  for (std::string line; std::getline(lines, line);) {
    const Json entry = Json::parse(line);
    if (entry.at("phase") == "train") rates.push_back(entry.at("learning_rate"));
  }
  return rates;
}

/// Two epochs of three steps, then two more: the last stage again, with its own schedule over six steps.
TEST(Trainer, ALongerTrainingIsAStageOfItsOwn) {
  for (const std::vector<Stage>& stages :
       {std::vector<Stage>{{"", 1, 1}}, {{"one", 0.5, 1}, {"two", 0.5, 0.1}}, {{"one", 1, 0.1}, {"none", 0, 1}}}) {
    SCOPED_TRACE(stages.size());
    const testing::TempDir run;
    ToyRecipe first, longer;
    first.parts = longer.parts = stages;
    TrainerOptions options = Epochs(2);
    options.log_every = 1;
    Train(first, options, Fast(), 5, run.path());
    options.epochs = 4;
    const TrainingSummary summary = Train(longer, options, Fast(), 5, run.path(), {}, {{2, 2}});
    EXPECT_EQ(summary.steps, 12);
    EXPECT_EQ(longer.num_calls, 6);
    EXPECT_EQ(longer.epochs, (std::vector<int64_t>{2, 2, 2, 3, 3, 3}));
    const std::vector<double> rates = RatesOf(run.path());
    ASSERT_EQ(rates.size(), 12u);
    const double factor = stages.size() > 1 ? 0.1 : 1;
    for (int step = 6; step < 12; ++step)
      EXPECT_NEAR(rates[size_t(step)], factor * LearningRate(Fast(), step - 6, 6), 1e-9) << step;
    EXPECT_EQ(longer.entered.back(), (std::pair<int, int>{stages.size() == 2 && stages[1].share > 0 ? 1 : 0, 0}));
  }
}

TEST(Trainer, ALongerTrainingThatIsResumedEqualsAnUninterruptedOne) {
  const testing::TempDir whole, stopped;
  for (const std::filesystem::path& run : {whole.path(), stopped.path()}) {
    ToyRecipe first;
    torch::manual_seed(9);
    Train(first, Epochs(2), Fast(), 5, run);
  }
  ToyRecipe uninterrupted, killed, resumed, longest;
  Train(uninterrupted, Epochs(4), Fast(), 5, whole.path(), {}, {{2, 2}});
  killed.before_loss = [](int call) {
    if (call == 4) throw Stopped();
  };
  EXPECT_THROW(Train(killed, Epochs(4), Fast(), 5, stopped.path(), {}, {{2, 2}}), Stopped);
  Train(resumed, Epochs(4), Fast(), 5, stopped.path(), {}, {{2, 2}});
  ExpectSameContent(stopped.path(), whole.path());
  const TrainingSummary summary = Train(longest, Epochs(5), Fast(), 5, whole.path(), {}, {{2, 2}, {4, 4}});
  EXPECT_EQ(summary.epochs, 5);
  EXPECT_EQ(longest.num_calls, 3);
}

TEST(Trainer, ATrainingThatStoppedEarlyIsContinuedFromItsLastEpoch) {
  const testing::TempDir run;
  ToyRecipe first, again, longer;
  first.before_loss = [&](int call) { first.offset = call; };  // Each validation is worse.
  TrainerOptions options = Epochs(9);
  options.patience = 1;
  EXPECT_EQ(Train(first, options, Fast(), 5, run.path()).epochs, 2);
  options.epochs = 12;
  options.patience = 0;
  const TrainingSummary summary = Train(longer, options, Fast(), 5, run.path(), {}, {{9, 2}});
  EXPECT_FALSE(summary.stopped_early);
  EXPECT_EQ(summary.epochs, 12);
  EXPECT_EQ(longer.num_calls, 30);
  testing::ExpectError(
      [&] {
        Train(again, Epochs(2), Fast(), 5, run.path(), {}, {{9, 2}});
      },
      "expected one after epoch 2");
}

TEST(Trainer, ThrowsTheErrorOfALoaderAtItsStepAndResumesFromTheCheckpoint) {
  const testing::TempDir whole, failed;
  ToyRecipe uninterrupted, first, second;
  torch::manual_seed(9);
  Train(uninterrupted, FourEpochs(), Fast(), 5, whole.path());
  first.before_read = [](int read) {
    if (read == 8) throw Error("shard 3 is damaged");
  };
  torch::manual_seed(9);
  testing::ExpectError([&] { Train(first, FourEpochs(), Fast(), 5, failed.path()); }, "shard 3 is damaged");
  EXPECT_EQ(first.num_calls, 7);
  torch::manual_seed(9);
  Train(second, FourEpochs(), Fast(), 5, failed.path());
  ExpectSameContent(failed.path(), whole.path());
}

TEST(Trainer, ResumedEqualsUninterruptedWithAccumulation) {
  const testing::TempDir whole, killed;
  TrainerOptions options = FourEpochs();
  options.batch = 3;
  options.accumulate = 2;
  options.checkpoint_every = 1;
  ToyRecipe uninterrupted, first, second;
  torch::manual_seed(9);
  Train(uninterrupted, options, Fast(), 5, whole.path());
  first.before_loss = [](int call) {
    if (call == 10) throw Stopped();  // The second batch of the fifth step.
  };
  torch::manual_seed(9);
  EXPECT_THROW(Train(first, options, Fast(), 5, killed.path()), Stopped);
  torch::manual_seed(9);
  Train(second, options, Fast(), 5, killed.path());
  EXPECT_EQ(second.num_calls, 16);
  ExpectSameContent(killed.path(), whole.path());
}

TEST(Trainer, TrainingTimeContinuesOverResumes) {
  const testing::TempDir run;
  ToyRecipe first, second;
  first.before_loss = [](int call) {
    if (call == 8) throw Stopped();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  };
  EXPECT_THROW(Train(first, FourEpochs(), Fast(), 5, run.path()), Stopped);
  const double saved = ReadCheckpoint(LatestCheckpoint(run.path())).value().seconds.value();
  EXPECT_GE(saved, 6 * 0.02);
  const TrainingSummary summary = Train(second, FourEpochs(), Fast(), 5, run.path());
  EXPECT_GT(summary.seconds, saved);
  double last = 0;
  for (const auto& [line, seconds] : ReadMetrics(run.path())) {
    EXPECT_EQ(line.at("seconds").get<double>(), seconds);
    EXPECT_GE(seconds, last);
    if (line.at("step") > 6) {
      EXPECT_NEAR(seconds - line.at("session_seconds").get<double>(), saved, 1e-9);
    }
    last = seconds;
  }
  EXPECT_GE(summary.seconds, last);
}

TEST(Trainer, ResumesOnTheCpuACheckpointOfAGpuAndOfAnOlderVersion) {
  const testing::TempDir whole, moved;
  ToyRecipe uninterrupted, first, second;
  torch::manual_seed(9);
  Train(uninterrupted, FourEpochs(), Fast(), 5, whole.path());
  first.before_loss = [](int call) {
    if (call == 8) throw Stopped();
  };
  torch::manual_seed(9);
  EXPECT_THROW(Train(first, FourEpochs(), Fast(), 5, moved.path()), Stopped);
  Checkpoint checkpoint = ReadCheckpoint(LatestCheckpoint(moved.path())).value();
  checkpoint.random["cuda:0"] = torch::zeros({16}, torch::kUInt8);
  checkpoint.seconds.reset();
  WriteCheckpoint(LatestCheckpoint(moved.path()), checkpoint);
  Train(second, FourEpochs(), Fast(), 5, moved.path());
  ExpectSameContent(moved.path(), whole.path());
  const auto records = ReadMetrics(moved.path());
  for (size_t i = 1; i < records.size(); ++i) EXPECT_GE(records[i].seconds, records[i - 1].seconds);
}

}  // namespace
}  // namespace daumier::train
