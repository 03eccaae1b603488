#include "train/trainer.h"

#include "core/error.h"
#include "core/log.h"
#include "core/prefetch.h"
#include "core/progress.h"
#include "core/run_manifest.h"
#include "core/stopwatch.h"
#include "tensor/autocast.h"
#include "tensor/module_state.h"
#include "tensor/torch_version.h"
#include "train/checkpoint.h"
#include "train/random_state.h"
#include "train/run_log.h"
#include "train/sample_order.h"
#include "train/step_sums.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace daumier::train {
namespace {

class Training {
 public:
  Training(Recipe& recipe, const TrainerOptions& options, const OptimiserOptions& optimiser_options, uint64_t seed,
           const std::filesystem::path& run_directory, const Task& task, const std::vector<EarlierTraining>& earlier)
      : recipe_(recipe),
        task_(task),
        options_(options),
        optimiser_options_(optimiser_options),
        run_directory_(run_directory),
        order_(seed, recipe.num_samples(), options.batch, options.accumulate),
        steps_per_epoch_(order_.steps_per_epoch()),
        total_steps_(steps_per_epoch_ * options.epochs),
        optimiser_(recipe.module(), optimiser_options, recipe.groups()) {
    std::vector<EarlierTraining> trainings = earlier;
    trainings.push_back({options.epochs, options.epochs});
    AddStages(trainings.front());
    for (size_t i = 1; i < trainings.size(); ++i) {
      last_training_begin_ = stages_.back().end;
      AddLongerStage(trainings[i]);
    }
  }

  TrainingSummary Run() {
    const bool has_time = Restore();
    EnterStage();
    if (!has_time) seconds_before_ = SecondsOfLog();
    if (step_ >= total_steps_ || stopped_early_) {
      log::Info("{} is finished after {} epochs. To train it longer: {}", run_directory_.string(),
                step_ / steps_per_epoch_, ResumeCommand(run_directory_, fmt::format("epochs={}", 2 * options_.epochs)));
      return Summary(seconds_before_);
    }
    RunLog log(run_directory_, step_);
    Progress progress(task_.Stage("Training"), total_steps_, "steps", step_);
    recipe_.module().train();
    BatchLoader loader(step_ * options_.accumulate, total_steps_ * options_.accumulate, [this](int64_t index) {
      return recipe_.Read(order_.Batch(index), order_.Epoch(index / options_.accumulate));
    });
    while (step_ < total_steps_ && !stopped_early_) {
      if (step_ == stages_[size_t(stage_)].end) BeginNextStage();
      TakeStep(loader);
      progress.Step(1, fmt::format("loss {:.4g}", last_loss_));
      if (sums_.num_steps() == options_.log_every) WriteTrainingLine(log);
      const bool validated = step_ % (steps_per_epoch_ * options_.validate_every) == 0 || step_ == total_steps_;
      if (validated) Validate(log);
      const bool periodic = options_.checkpoint_every > 0 && step_ % options_.checkpoint_every == 0;
      const bool stopped = task_.cancelled();
      if (validated || periodic || stopped) Save();
      if (stopped && step_ < total_steps_ && !stopped_early_)
        throw Cancelled(fmt::format("interrupted at step {} of {}; checkpoint saved. Resume with: {}", step_,
                                    total_steps_,
                                    ResumeCommand(run_directory_, recipe_.device().is_cpu() ? "" : "--device cuda")));
    }
    return Summary(Time().total);
  }

 private:
  using BatchLoader = Prefetcher<SampleBatch>;

  TrainingSummary Summary(double seconds) const {
    return {.steps = step_,
            .epochs = step_ / steps_per_epoch_,
            .stopped_early = stopped_early_,
            .metric = recipe_.metric(),
            .best = best_,
            .best_epoch = best_epoch_,
            .seconds = seconds};
  }

  TrainingTime Time() const {
    const double session = stopwatch_.seconds();
    return {seconds_before_ + session, session};
  }

  struct Part {
    Stage stage;
    int index;           ///< Of the recipe's stages.
    int64_t begin, end;  ///< Steps.
  };

  /// The recipe's stages, of the first training of a run.
  void AddStages(const EarlierTraining& training) {
    const int64_t planned = steps_per_epoch_ * training.planned_epochs;
    int64_t begin = 0;
    double share = 0;
    for (const Stage& stage : recipe_.stages()) {
      share += stage.share;
      const int64_t end = std::llround(share * double(planned));
      stages_.push_back({stage, int(stages_.size()), begin, end});
      begin = end;
    }
    DAUMIER_CHECK(!stages_.empty() && begin == planned,
                  "the shares of the stages of a training add up to {}, expected 1", share);
    const int64_t finished = steps_per_epoch_ * training.epochs;  // A training that stopped early cuts them.
    for (Part& part : stages_) {
      part.begin = std::min(part.begin, finished);
      part.end = std::min(part.end, finished);
    }
  }

  /// The last stage that had a step, continued to the end of a later training.
  void AddLongerStage(const EarlierTraining& training) {
    const auto last =
        std::find_if(stages_.rbegin(), stages_.rend(), [](const Part& part) { return part.begin < part.end; });
    DAUMIER_CHECK(last != stages_.rend(), "a training without a step cannot be continued");
    Part part = *last;
    const std::string name = recipe_.stages()[size_t(part.index)].name;
    part.stage.name = name.empty() ? "longer" : name + ", longer";
    part.begin = stages_.back().end;
    part.end = steps_per_epoch_ * training.epochs;
    DAUMIER_CHECK(part.end > part.begin, "a longer training ends at epoch {}, expected one after epoch {}",
                  training.epochs, part.begin / steps_per_epoch_);
    stages_.push_back(part);
  }

  void EnterStage() {
    const Part& part = stages_[size_t(stage_)];
    recipe_.EnterStage(part.index);
    if (!part.stage.name.empty() && step_ < part.end)
      log::Info("Stage {}: steps {} to {} of {}", part.stage.name, part.begin + 1, part.end, total_steps_);
  }

  /// Skips stages without steps.
  void BeginNextStage() {
    CheckFinite();
    while (stages_[size_t(stage_)].end <= step_) ++stage_;
    EnterStage();
    optimiser_.Reset();
  }

  double Rate(int64_t step) const {
    const Part& part = stages_[size_t(stage_)];
    return part.stage.rate * LearningRate(optimiser_options_, step - part.begin, part.end - part.begin);
  }

  void TakeStep(BatchLoader& loader) {
    optimiser_.ZeroGradients();
    std::map<std::string, torch::Tensor> numbers;
    for (int k = 0; k < options_.accumulate; ++k) {
      LossTerms loss = Loss(ToDevice(loader.Next(), recipe_.device()));
      loss.parts["loss"] = loss.total.detach();
      for (const auto& [name, part] : loss.parts) AddShare(part.detach(), numbers[name]);
      (options_.accumulate == 1 ? loss.total : loss.total / options_.accumulate).backward();
    }
    const torch::Tensor norm = optimiser_.GradientNorm();
    numbers["gradient_norm"] = norm;
    const double rate = Rate(step_);
    sums_.Add(step_, numbers);
    rates_ += rate;
    // Reading a number waits for a GPU: there it is done where numbers are written. A CPU has nothing to wait for.
    if (recipe_.device().is_cpu()) {
      last_loss_ = numbers.at("loss").item<double>();
      CheckFinite();
    }
    if (optimiser_options_.clip_norm > 0) optimiser_.ClipGradients(norm, optimiser_options_.clip_norm);
    optimiser_.Step(rate);
    ++step_;
  }

  /// Adds a batch's share of a mean over the batches of a step.
  void AddShare(const torch::Tensor& number, torch::Tensor& sum) const {
    const torch::Tensor share = options_.accumulate == 1 ? number : number / options_.accumulate;
    sum = sum.defined() ? sum + share : share;
  }

  LossTerms Loss(const Batch& batch) {
    const tensor::Autocast precision(recipe_.device(), options_.precision == "bfloat16");
    return recipe_.Loss(batch);
  }

  /// @throws Error if a step since the last check had a number that is not finite, once its batch is written.
  void CheckFinite() const {
    const std::optional<NotFinite> bad = sums_.FirstNotFinite();
    if (!bad) return;
    const std::filesystem::path file = run_directory_ / "nan_batch.safetensors";
    const int64_t epoch = order_.Epoch(bad->step);
    const Batch batch = ToDevice(recipe_.Read(order_.Step(bad->step), epoch), torch::kCPU);
    tensor::NamedTensors tensors = batch.tensors;
    tensors["samples"] = batch.samples;
    tensor::SaveTensors(file, tensors);
    throw Error(
        fmt::format("{} is {} in step {} (epoch {}), with a learning rate of {:.3g}; its batch is in {}. Try a smaller "
                    "optimiser.learning_rate or optimiser.clip_norm=1",
                    bad->name, bad->value, bad->step + 1, epoch + 1, Rate(bad->step), file.string()));
  }

  void WriteTrainingLine(RunLog& log) {
    CheckFinite();
    std::map<std::string, double> means = sums_.Totals();
    means["learning_rate"] = rates_;
    for (auto& [name, sum] : means) sum /= double(sums_.num_steps());
    last_loss_ = means.at("loss");
    log.Write(step_, (step_ - 1) / steps_per_epoch_ + 1, "train", means, Time());
    sums_.Clear();
    rates_ = 0;
  }

  void Validate(RunLog& log) {
    CheckFinite();
    const int64_t epoch = step_ / steps_per_epoch_;
    recipe_.module().eval();
    std::map<std::string, double> values;
    {
      const at::NoGradGuard no_grad;
      values = recipe_.Validate();
    }
    recipe_.module().train();
    const double value = values.at(recipe_.metric());
    DAUMIER_CHECK(std::isfinite(value), "the validation's {} is {} after epoch {}", recipe_.metric(), value, epoch);
    log.Write(step_, epoch, "validation", values, Time());
    if (best_epoch_ == 0 || value < best_) {
      best_ = value;
      best_epoch_ = epoch;
      MakeDirectory(BestWeights(run_directory_).parent_path());
      tensor::SaveModule(BestWeights(run_directory_), recipe_.product());
    }
    const int64_t last_stage = stages_.back().begin / steps_per_epoch_;
    stopped_early_ = options_.patience > 0 && epoch - std::max(best_epoch_, last_stage) >= options_.patience;
  }

  void Save() {
    CheckFinite();
    Checkpoint checkpoint;
    checkpoint.model = tensor::StateOf(recipe_.module());
    checkpoint.optimiser = optimiser_.State();
    checkpoint.random = RandomState(recipe_.device());
    std::map<std::string, double> sums = sums_.Totals();
    if (sums_.num_steps() > 0) sums["learning_rate"] = rates_;
    checkpoint.state = {{"step", step_},
                        {"stage", stage_},
                        {"best", best_},
                        {"best_epoch", best_epoch_},
                        {"stopped_early", stopped_early_},
                        {"sums", sums},
                        {"num_summed", sums_.num_steps()}};
    checkpoint.seconds = Time().total;
    WriteCheckpoint(CheckpointDirectory(), checkpoint);
  }

  /// Returns whether the training time until now is known: false for a checkpoint of an older version.
  bool Restore() {
    const std::optional<Checkpoint> checkpoint = ReadCheckpoint(CheckpointDirectory());
    if (!checkpoint) return true;
    const std::string where = CheckpointDirectory().string();
    tensor::LoadState(recipe_.module(), checkpoint->model, where);
    optimiser_.LoadState(checkpoint->optimiser, where);
    LoadRandomState(checkpoint->random, recipe_.device(), where);
    const Json& state = checkpoint->state;
    step_ = state.at("step").get<int64_t>();
    stage_ = state.at("stage").get<int>();
    best_ = state.at("best").get<double>();
    best_epoch_ = state.at("best_epoch").get<int64_t>();
    stopped_early_ = state.at("stopped_early").get<bool>() && step_ != last_training_begin_;
    auto sums = state.at("sums").get<std::map<std::string, double>>();
    if (const auto rates = sums.extract("learning_rate")) rates_ = rates.mapped();
    sums_.Load(std::move(sums), state.at("num_summed").get<int>());
    seconds_before_ = checkpoint->seconds.value_or(0);
    return checkpoint->seconds.has_value();
  }

  /// The training time until the last line of the log.
  double SecondsOfLog() const {
    const std::vector<MetricsRecord> records = ReadMetrics(run_directory_);
    return records.empty() ? 0 : records.back().seconds;
  }

  std::filesystem::path CheckpointDirectory() const { return LatestCheckpoint(run_directory_); }

  Recipe& recipe_;
  const Task task_;
  const TrainerOptions options_;
  const OptimiserOptions optimiser_options_;
  const std::filesystem::path run_directory_;
  const SampleOrder order_;
  const int64_t steps_per_epoch_, total_steps_;
  const Stopwatch stopwatch_;
  double seconds_before_ = 0;  ///< Of training before this session.
  Optimiser optimiser_;
  std::vector<Part> stages_;
  std::optional<int64_t> last_training_begin_;  ///< The step where this training continues an earlier one.
  int stage_ = 0;                               ///< Index into stages_.

  int64_t step_ = 0;  ///< Finished ones.
  double best_ = 0;
  int64_t best_epoch_ = 0;  ///< 0: none yet.
  bool stopped_early_ = false;
  StepSums sums_;  ///< Since the last line of the log.
  double rates_ = 0;
  double last_loss_ = 0;  ///< The last one that was read.
};

}  // namespace

TrainingSummary Train(Recipe& recipe, const TrainerOptions& options, const OptimiserOptions& optimiser_options,
                      uint64_t seed, const std::filesystem::path& run_directory, const Task& task,
                      const std::vector<EarlierTraining>& earlier) {
  return Training(recipe, options, optimiser_options, seed, run_directory, task, earlier).Run();
}

}  // namespace daumier::train
