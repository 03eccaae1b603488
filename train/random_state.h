#pragma once
#include "tensor/tensor_file.h"

#include <string>

namespace daumier::train {

/// States of LibTorch's generators that a training on this device draws from, by device: "cpu", and "cuda:0" on a GPU.
tensor::NamedTensors RandomState(const torch::Device& device);

/// Restores what RandomState returned, perhaps on another device. A generator without a state here keeps its own, and a
/// state of a kind of device that this training does not draw from is skipped; both are logged.
/// @throws Error naming `where` if a state does not fit its generator.
void LoadRandomState(const tensor::NamedTensors& state, const torch::Device& device, const std::string& where);

}  // namespace daumier::train
