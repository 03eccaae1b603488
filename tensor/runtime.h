#pragma once
#include <torch/types.h>

#include <string>

namespace daumier::tensor {

/// Sets how many threads LibTorch uses; 0 means every core that this process may run on (LibTorch 1.13's own default is
/// half of them). Returns the number in force. @throws Error if `threads` is negative.
int SetUpTorch(int threads = 0);

/// The device of `--device cpu` or `--device cuda` (also `cuda:1`).
/// @throws UsageError for any other text, and Error telling what to do if this LibTorch or this machine has no such
/// CUDA device.
torch::Device ParseDevice(const std::string& name);

}  // namespace daumier::tensor
