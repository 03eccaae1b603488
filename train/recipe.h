#pragma once
#include "train/batch.h"
#include "train/optimiser.h"

#include <torch/nn/module.h>

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace daumier::train {

/// What a step minimises, and the named numbers that it is made of; both differentiable scalars.
struct LossTerms {
  torch::Tensor total;
  std::map<std::string, torch::Tensor> parts;
};

/// A part of a training with its own loss, warm-up and decay of the learning rate.
struct Stage {
  std::string name;  ///< Printed in the log.
  double share = 1;  ///< Of all steps; those of a recipe add up to 1.
  double rate = 1;   ///< Factor of the learning rate.
};

/// One kind of training, seen by the one loop: which network, which samples, which loss, which measure of success.
class Recipe {
 public:
  virtual ~Recipe() = default;

  /// All that is trained, in whatever stage.
  virtual torch::nn::Module& module() = 0;
  /// What best/ keeps of it.
  virtual torch::nn::Module& product() { return module(); }
  virtual torch::Device device() const = 0;
  virtual int num_samples() const = 0;
  virtual std::vector<Stage> stages() const { return {{"", 1, 1}}; }
  /// The losses from now on are those of this stage. Called before the first step of a stage, and on resuming within
  /// it.
  virtual void EnterStage(int) {}
  /// Parameters that train at another rate or decay; none by default.
  virtual std::vector<ParameterGroup> groups() const { return {}; }
  /// Reads training samples, each in 0 .. num_samples - 1, as the epoch shows them, 0 the first. A function of its
  /// arguments alone; draws nothing from LibTorch's generators. Loader threads call it while Loss runs.
  virtual SampleBatch Read(std::span<const int> samples, int64_t epoch) const = 0;
  /// The loss of what Read returned, moved to the device: a mean over the samples. Reads no data, and does not wait for
  /// the device. Runs under tensor::Autocast in the precision of TrainerOptions. Deterministic but for LibTorch's
  /// generators.
  virtual LossTerms Loss(const Batch& batch) = 0;
  /// Numbers over the validation samples; the network is in evaluation mode and no gradient is kept.
  virtual std::map<std::string, double> Validate() = 0;
  /// Which of Validate's numbers chooses the best weights; smaller is better.
  virtual std::string metric() const = 0;
};

}  // namespace daumier::train
