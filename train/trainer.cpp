#include "train/trainer.h"

#include "core/error.h"
#include "core/interrupt.h"
#include "core/log.h"
#include "core/progress.h"
#include "core/random.h"
#include "core/run_manifest.h"
#include "tensor/module_state.h"
#include "tensor/torch_version.h"
#include "train/checkpoint.h"
#include "train/run_log.h"

#include <ATen/Context.h>

#include <chrono>
#include <cmath>
#include <limits>

namespace daumier::train {
namespace {

/// Generators of the devices that a training draws from.
std::vector<torch::Device> RandomDevices(const torch::Device& device) {
  std::vector<torch::Device> devices{torch::Device(torch::kCPU)};
  if (device.is_cuda()) devices.push_back(device);
  return devices;
}

class Training {
 public:
  Training(Recipe& recipe, const TrainerOptions& options, const OptimiserOptions& optimiser_options, uint64_t seed,
           const std::filesystem::path& run_directory)
      : recipe_(recipe),
        options_(options),
        optimiser_options_(optimiser_options),
        seed_(seed),
        run_directory_(run_directory),
        batch_(std::min(options.batch, recipe.num_samples())),
        optimiser_(recipe.module(), optimiser_options) {
    DAUMIER_CHECK(recipe.num_samples() > 0, "there is no training sample");
    steps_per_epoch_ = recipe.num_samples() / batch_;
    total_steps_ = steps_per_epoch_ * options.epochs;
    double share = 0;
    for (const Stage& stage : recipe.stages()) {
      const auto begin = stages_.empty() ? 0 : stages_.back().end;
      share += stage.share;
      stages_.push_back({stage, begin, std::llround(share * double(total_steps_))});
    }
    DAUMIER_CHECK(!stages_.empty() && stages_.back().end == total_steps_,
                  "the shares of the stages of a training add up to {}, expected 1", share);
  }

  TrainingSummary Run() {
    Restore();
    EnterStage();
    RunLog log(run_directory_, step_);
    Progress progress("Training", total_steps_ - step_, "steps");
    recipe_.module().train();
    std::vector<int> order;
    for (bool first = true; step_ < total_steps_ && !stopped_early_; first = false) {
      const int64_t position = step_ % steps_per_epoch_;
      if (first || position == 0)
        order = Stream(seed_, "training order", uint64_t(Epoch())).Permutation(recipe_.num_samples());
      if (step_ == stages_[size_t(stage_)].end) BeginNextStage();
      const auto begin = order.begin() + position * batch_;
      TakeStep({begin, begin + batch_});
      progress.Step(1, fmt::format("loss {:.4g}", last_loss_));
      if (num_summed_ == options_.log_every) WriteTrainingLine(log);
      const bool validated = step_ % (steps_per_epoch_ * options_.validate_every) == 0 || step_ == total_steps_;
      if (validated) Validate(log);
      const bool periodic = options_.checkpoint_every > 0 && step_ % options_.checkpoint_every == 0;
      if (validated || periodic || Interrupted()) Save();
      const bool finished = step_ == total_steps_ || stopped_early_;
      DAUMIER_CHECK(
          finished || !Interrupted(),
          "training was stopped after step {} of {} and is saved; go on with: daumier train CONFIG --out {} --resume",
          step_, total_steps_, run_directory_.string());
    }
    return {.steps = step_,
            .epochs = step_ / steps_per_epoch_,
            .stopped_early = stopped_early_,
            .metric = recipe_.metric(),
            .best = best_,
            .best_epoch = best_epoch_,
            .seconds = Seconds()};
  }

 private:
  double Seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

  /// Of the step under way, 0 the first.
  int64_t Epoch() const { return step_ / steps_per_epoch_; }

  struct Part {
    Stage stage;
    int64_t begin, end;  ///< Steps.
  };

  void EnterStage() {
    const Part& part = stages_[size_t(stage_)];
    recipe_.EnterStage(stage_);
    if (stages_.size() > 1)
      log::Info("Stage {}: steps {} to {} of {}", part.stage.name, part.begin + 1, part.end, total_steps_);
  }

  /// One without steps is passed over.
  void BeginNextStage() {
    while (stages_[size_t(stage_)].end <= step_) ++stage_;
    EnterStage();
    optimiser_.Reset();
  }

  /// Of the step under way.
  double Rate() const {
    const Part& part = stages_[size_t(stage_)];
    return part.stage.rate * LearningRate(optimiser_options_, step_ - part.begin, part.end - part.begin);
  }

  void TakeStep(const std::vector<int>& samples) {
    optimiser_.ZeroGradients();
    const Batch batch = ToDevice(recipe_.Read(samples, Epoch()), recipe_.device());
    const LossTerms loss = recipe_.Loss(batch);
    last_loss_ = loss.total.item<double>();
    std::map<std::string, double> values{{"loss", last_loss_}};
    for (const auto& [name, part] : loss.parts) values[name] = part.item<double>();
    for (const auto& [name, value] : values) CheckFinite(value, name, batch);
    loss.total.backward();
    const double norm = optimiser_.GradientNorm();
    CheckFinite(norm, "gradient", batch);
    values["gradient_norm"] = norm;
    values["learning_rate"] = Rate();
    if (optimiser_options_.clip_norm > 0 && norm > optimiser_options_.clip_norm)
      optimiser_.ScaleGradients(optimiser_options_.clip_norm / norm);
    optimiser_.Step(values["learning_rate"]);
    ++step_;
    for (const auto& [name, value] : values) sums_[name] += value;
    ++num_summed_;
  }

  void CheckFinite(double value, const std::string& name, const Batch& batch) {
    if (std::isfinite(value)) return;
    const std::filesystem::path file = run_directory_ / "nan_batch.safetensors";
    tensor::NamedTensors tensors = batch.tensors;
    tensors["samples"] = batch.samples;
    tensor::SaveTensors(file, tensors);
    throw Error(
        fmt::format("{} is {} in step {} (epoch {}), with a learning rate of {:.3g}; its batch is in {}. Try a smaller "
                    "optimiser.learning_rate or optimiser.clip_norm=1",
                    name, value, step_ + 1, Epoch() + 1, Rate(), file.string()));
  }

  void WriteTrainingLine(RunLog& log) {
    for (auto& [name, sum] : sums_) sum /= double(num_summed_);
    log.Write(step_, (step_ - 1) / steps_per_epoch_ + 1, "train", sums_, Seconds());
    sums_.clear();
    num_summed_ = 0;
  }

  void Validate(RunLog& log) {
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
    log.Write(step_, epoch, "validation", values, Seconds());
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
    Checkpoint checkpoint;
    checkpoint.model = tensor::StateOf(recipe_.module());
    checkpoint.optimiser = optimiser_.State();
    for (const torch::Device& device : RandomDevices(recipe_.device()))
      checkpoint.random[device.str()] = at::globalContext().defaultGenerator(device).get_state();
    checkpoint.state = {{"step", step_},
                        {"stage", stage_},
                        {"best", best_},
                        {"best_epoch", best_epoch_},
                        {"stopped_early", stopped_early_},
                        {"sums", sums_},
                        {"num_summed", num_summed_}};
    WriteCheckpoint(CheckpointDirectory(), checkpoint);
  }

  void Restore() {
    const std::optional<Checkpoint> checkpoint = ReadCheckpoint(CheckpointDirectory());
    if (!checkpoint) return;
    const std::string where = CheckpointDirectory().string();
    tensor::LoadState(recipe_.module(), checkpoint->model, where);
    optimiser_.LoadState(checkpoint->optimiser, where);
    for (const auto& [device, random_state] : checkpoint->random) {
      at::Generator generator = at::globalContext().defaultGenerator(torch::Device(device));
      generator.set_state(random_state);
    }
    const Json& state = checkpoint->state;
    step_ = state.at("step").get<int64_t>();
    stage_ = state.at("stage").get<int>();
    best_ = state.at("best").get<double>();
    best_epoch_ = state.at("best_epoch").get<int64_t>();
    stopped_early_ = state.at("stopped_early").get<bool>();
    sums_ = state.at("sums").get<std::map<std::string, double>>();
    num_summed_ = state.at("num_summed").get<int>();
  }

  std::filesystem::path CheckpointDirectory() const { return LatestCheckpoint(run_directory_); }

  Recipe& recipe_;
  const TrainerOptions options_;
  const OptimiserOptions optimiser_options_;
  const uint64_t seed_;
  const std::filesystem::path run_directory_;
  const int batch_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  Optimiser optimiser_;
  int64_t steps_per_epoch_ = 0, total_steps_ = 0;
  std::vector<Part> stages_;
  int stage_ = 0;

  int64_t step_ = 0;  ///< Finished ones.
  double best_ = 0;
  int64_t best_epoch_ = 0;  ///< 0: none yet.
  bool stopped_early_ = false;
  std::map<std::string, double> sums_;  ///< Since the last line of the log.
  int num_summed_ = 0;
  double last_loss_ = 0;
};

}  // namespace

TrainingSummary Train(Recipe& recipe, const TrainerOptions& options, const OptimiserOptions& optimiser_options,
                      uint64_t seed, const std::filesystem::path& run_directory) {
  return Training(recipe, options, optimiser_options, seed, run_directory).Run();
}

}  // namespace daumier::train
