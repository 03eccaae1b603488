#pragma once
#include "core/device.h"

#include <torch/types.h>

namespace daumier::tensor {

/// Sets how many threads LibTorch uses; 0 means every core that this process may run on (LibTorch 1.13's own default is
/// half of them). Returns the number in force. @throws Error if `threads` is negative.
int SetUpTorch(int threads = 0);

/// @throws Error with the repair if this LibTorch or this machine has no such CUDA device.
torch::Device TorchDevice(const Device& device);

}  // namespace daumier::tensor
