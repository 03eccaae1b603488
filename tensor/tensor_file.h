#pragma once
#include "core/safetensors.h"

#include <torch/types.h>

#include <filesystem>
#include <map>
#include <string>

/// Tensors in safetensors files: (u)int8, int16, int32, int64, float16, float32 and float64.
namespace daumier::tensor {

using NamedTensors = std::map<std::string, torch::Tensor>;

/// An array of a mapped file as a tensor without a copy. The tensor keeps the mapping alive; it must only be read, for
/// the memory is write-protected. @throws Error if there is no such array.
torch::Tensor ViewOfArray(const SafetensorsFile& file, const std::string& name);

/// Atomic; equal tensors give equal bytes, whatever their layout and device. Returns the file's SHA-256.
/// @throws Error naming the tensor if its element type cannot be stored, and as WriteFileAtomically.
std::string SaveTensors(const std::filesystem::path& file, const NamedTensors& tensors);

/// Copies of all arrays, free to be written. @throws Error as SafetensorsFile.
NamedTensors LoadTensors(const std::filesystem::path& file);

}  // namespace daumier::tensor
