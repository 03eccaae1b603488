#pragma once
#include "core/training.h"
#include "tensor/tensor_file.h"

#include <torch/nn/module.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace daumier::train {

/// The step size of step 0, 1, ..., total_steps - 1. With W = ceil(warm_up * total_steps), p = learning_rate and
/// f = final_rate:
///   p (step + 1) / W in the first W steps, then p (f + (1 - f) (1 + cos(pi (step - W) / (total_steps - W))) / 2).
double LearningRate(const OptimiserOptions& options, int64_t step, int64_t total_steps);

/// Parameters that train in another way than the rest: those whose dotted name begins with `prefix`.
struct ParameterGroup {
  std::string prefix;
  double rate = 1;                     ///< Factor of the learning rate.
  std::optional<double> weight_decay;  ///< Absent: that of OptimiserOptions.
};

/// With gradient g, at its t-th step, AdamW [Loshchilov and Hutter 2019]:
///   m = beta1 m + (1 - beta1) g,  v = beta2 v + (1 - beta2) g^2,
///   p -= rate (weight_decay p + m / (1 - beta1^t) / (sqrt(v / (1 - beta2^t)) + 1e-8)),
/// and gradient descent with momentum, as Caffe has it:
///   m = beta1 m + rate (g + weight_decay p),  p -= m,
/// where weight_decay is 0 for parameters of one dimension (biases and norms). A parameter without a gradient stays as
/// it is. Our own, since the state of LibTorch's optimisers is reached differently in every release, and a checkpoint
/// must not be.
class Optimiser {
 public:
  /// A parameter belongs to the first group whose prefix it has; to none: rate 1 and the decay of the options.
  /// @throws Error if nothing is to be trained or a group has no parameter that is.
  Optimiser(torch::nn::Module& module, const OptimiserOptions& options, const std::vector<ParameterGroup>& groups = {});

  void ZeroGradients();
  /// Length of all gradients together, a float64 scalar on their device; NaN or infinite if any of them is.
  torch::Tensor GradientNorm() const;
  /// Scales the gradients, whose length is `norm`, to the length `clip_norm` where they exceed it.
  void ClipGradients(const torch::Tensor& norm, double clip_norm);
  void Step(double learning_rate);
  /// Forgets all gradients of the past.
  void Reset();

  /// mean.NAME and square.NAME for every parameter, and the number of steps taken, for checkpoints; they share memory.
  tensor::NamedTensors State() const;
  /// @throws Error naming `where` if a tensor is missing or has another shape.
  void LoadState(const tensor::NamedTensors& state, const std::string& where);

 private:
  struct Slot {
    std::string name;
    torch::Tensor parameter, mean, square;
    double rate, weight_decay;
  };
  void StepAdamW(double learning_rate);
  void StepSgd(Slot& slot, double rate) const;

  OptimiserOptions options_;
  std::vector<Slot> slots_;
  torch::Tensor num_steps_;  ///< (1) int64 on the CPU.
};

}  // namespace daumier::train
