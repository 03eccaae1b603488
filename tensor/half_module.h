#pragma once
#include "tensor/module_state.h"

/// A network's numbers in half the space: float32 tensors of two or more dimensions (weights of convolutions and
/// products) are stored as float16; biases, batch norms and integers, which are few, as they are.
namespace daumier::tensor {

/// The state as it is stored. @throws Error naming the tensor and its largest value if that is not finite or beyond
/// kLargestHalf.
NamedTensors HalvedState(const NamedTensors& state);

/// Writes HalvedState of a module; returns the file's SHA-256.
std::string SaveHalfModule(const std::filesystem::path& file, const torch::nn::Module& module);

/// Reads what SaveHalfModule wrote into a float32 module. @throws Error as LoadModule.
void LoadHalfModule(const std::filesystem::path& file, torch::nn::Module& module);

}  // namespace daumier::tensor
