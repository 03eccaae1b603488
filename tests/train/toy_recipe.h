#pragma once
#include "train/trainer.h"

#include "core/files.h"
#include "core/interrupt.h"
#include "core/json.h"
#include "core/run_manifest.h"
#include "tensor/autocast.h"
#include "tensor/tensor_file.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"
#include "train/checkpoint.h"
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

#include <atomic>
#include <functional>
#include <limits>
#include <set>
#include <sstream>
#include <thread>

namespace daumier::train::toy {

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
  explicit ToyRecipe(uint64_t seed = 1, bool plain = false) {
    torch::manual_seed(seed);
    network_ = Network();
    if (plain) network_->layers = network_->replace_module("layers", torch::nn::Sequential(torch::nn::Linear(3, 1)));
    torch::manual_seed(77);
    inputs_ = torch::randn({26, 3});
    targets_ = inputs_.select(1, 0) - 2 * inputs_.select(1, 1);
  }

  torch::nn::Module& module() override { return *network_; }
  torch::Device device() const override { return torch::kCPU; }
  int num_samples() const override { return 20; }
  SampleBatch Read(std::span<const int> samples, int64_t epoch) const override {
    ++num_reads;
    if (before_read) before_read(num_reads);
    SampleBatch batch{.samples = {samples.begin(), samples.end()}, .arrays = {}, .indices = {}};
    const auto rows = [&](const torch::Tensor& all) {
      FloatArray array({int64_t(samples.size()), all.size(1)});
      for (size_t i = 0; i < samples.size(); ++i)
        std::copy_n(all.data_ptr<float>() + samples[i] * all.size(1), all.size(1), array.row(int64_t(i)));
      return array;
    };
    batch.arrays = {{"inputs", rows(inputs_)}, {"targets", rows(targets_.unsqueeze(1).contiguous())}};
    batch.indices["epoch"] = Array<int64_t>({1}, {epoch});
    return batch;
  }
  LossTerms Loss(const Batch& batch) override {
    ++num_calls;
    epochs.push_back(batch.at("epoch").item<int64_t>());
    const int64_t* const samples = batch.samples.data_ptr<int64_t>();
    seen.insert(seen.end(), samples, samples + batch.samples.numel());
    reduced.push_back(tensor::Autocast::IsOn(torch::kCPU));
    if (before_loss) before_loss(num_calls);
    const torch::Tensor error = network_->layers->forward(batch.at("inputs")) - batch.at("targets");
    torch::Tensor loss = error.square().mean() * scale;
    if (infinite_slope) loss = loss + (network_->parameters().front().sum() * 0).sqrt();
    return {loss, {{"absolute", error.abs().mean()}}};
  }
  std::map<std::string, double> Validate() override {
    EXPECT_FALSE(network_->is_training());
    const torch::Tensor error = network_->layers->forward(inputs_.slice(0, 20)).squeeze(1) - targets_.slice(0, 20);
    return {{"mean_error", error.abs().mean().item<double>() + offset}};
  }
  std::string metric() const override { return "mean_error"; }
  std::vector<Stage> stages() const override { return parts; }
  void EnterStage(int stage) override { entered.emplace_back(stage, num_calls); }
  std::vector<ParameterGroup> groups() const override { return parameter_groups; }

  mutable std::atomic<int> num_reads = 0;
  std::function<void(int read)> before_read;
  std::vector<ParameterGroup> parameter_groups;
  std::vector<bool> reduced;  ///< Whether Loss ran in bfloat16.
  std::function<void(int call)> before_loss;
  std::vector<int> seen;
  std::vector<int64_t> epochs;
  std::vector<Stage> parts{{"", 1, 1}};
  std::vector<std::pair<int, int>> entered;  ///< Stage, and the calls of Loss before it.
  int num_calls = 0;
  double scale = 1, offset = 0;
  bool infinite_slope = false;  ///< Adds the root of 0 times a weight: 0, with a gradient that is not a number.

 private:
  Network network_{nullptr};
  torch::Tensor inputs_, targets_;
};

/// Three steps an epoch of 20 samples, two left over.
inline TrainerOptions FourEpochs() {
  TrainerOptions options;
  options.epochs = 4;
  options.batch = 6;
  options.log_every = 2;
  return options;
}

inline OptimiserOptions Fast() {
  OptimiserOptions options;
  options.learning_rate = 0.02;
  return options;
}

/// The run's files without what holds a clock.
inline std::map<std::string, std::string> Content(const fs::path& run) {
  std::map<std::string, std::string> content;
  for (const char* file :
       {"best/model.safetensors", "checkpoints/latest/model.safetensors", "checkpoints/latest/optimiser.safetensors",
        "checkpoints/latest/random.safetensors", "checkpoints/latest/state.json"})
    content[file] = ReadFile(run / file);
  std::istringstream lines(ReadFile(run / RunLog::kMetricsFile));
  for (std::string line; std::getline(lines, line);) {
    Json entry = Json::parse(line);
    entry.erase("seconds");
    entry.erase("session_seconds");
    content[RunLog::kMetricsFile] += entry.dump() + "\n";
  }
  for (const ScalarEvent& event : ReadEvents(run / RunLog::kEventFile))
    content["events"] += fmt::format("{} {} {}\n", event.step, event.tag, event.value);
  return content;
}

inline void ExpectSameContent(const fs::path& run, const fs::path& other) {
  const auto content = Content(run), expected = Content(other);
  for (const auto& [name, bytes] : expected) EXPECT_EQ(content.at(name), bytes) << name;
}

struct Stopped {};

}  // namespace daumier::train::toy
