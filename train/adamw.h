#pragma once
#include <torch/types.h>

#include <cstdint>
#include <vector>

namespace daumier::train {

/// The factors of a step of AdamW [Loshchilov and Hutter 2019], rounded to the tensors' element type where they meet
/// it:
///   m = beta1 m + (1 - beta1) g,  v = beta2 v + (1 - beta2) g^2,
///   p = decay p - step_size m / (sqrt(v) / root_correction + 1e-8).
struct AdamWFactors {
  double beta1, beta2;
  double decay;            ///< 1 - rate * weight_decay.
  double root_correction;  ///< sqrt(1 - beta2^t).
  double step_size;        ///< rate / (1 - beta1^t).
};

/// A step of one parameter: its state and gradient, all of one shape and device.
struct AdamWUpdate {
  AdamWFactors factors;
  torch::Tensor parameter, gradient, mean, square;
};

/// By tensor operations, on any device. The readable twin of UpdateAdamW.
void UpdateAdamWByTensors(const AdamWUpdate& update);

/// All updates in one pass over the memory of those that are float32 on a CPU with FMA, by all threads of LibTorch. The
/// bytes are those of UpdateAdamWByTensors, whatever the number of threads; it updates the rest.
void UpdateAdamW(const std::vector<AdamWUpdate>& updates);

}  // namespace daumier::train
