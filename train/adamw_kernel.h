#pragma once
#include "train/adamw.h"

namespace daumier::train {

/// Whether this processor computes as LibTorch's vectorised operations do, with fused multiply-add.
bool HasAdamWKernel();

/// Numbers of one parameter, in the order in which they lie in memory.
struct AdamWNumbers {
  const float* gradient;
  float *mean, *square, *parameter;
};

/// The step of AdamW for the numbers begin .. end - 1, in the one thread that calls it, with the roundings of
/// UpdateAdamWByTensors. HasAdamWKernel() must be true.
void AdamWKernel(const AdamWFactors& factors, const AdamWNumbers& numbers, int64_t begin, int64_t end);

}  // namespace daumier::train
