#pragma once
#include "tensor/tensor_file.h"

#include <torch/nn/module.h>

#include <filesystem>
#include <string>

namespace daumier::tensor {

/// Parameters and buffers of a module by their dotted names; they share the module's memory.
NamedTensors StateOf(const torch::nn::Module& module);

/// Copies `state` into the module, wherever the module lives; nothing is changed if it does not fit. `where` names the
/// source in messages. @throws Error listing the tensors that are missing, not known to the module, or of another shape
/// or element type.
void LoadState(torch::nn::Module& module, const NamedTensors& state, const std::string& where);

/// SaveTensors(file, StateOf(module)); returns the file's SHA-256.
std::string SaveModule(const std::filesystem::path& file, const torch::nn::Module& module);

/// LoadState of a file. @throws Error as LoadState and SafetensorsFile.
void LoadModule(const std::filesystem::path& file, torch::nn::Module& module);

}  // namespace daumier::tensor
