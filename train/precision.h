#pragma once
#include <torch/types.h>

#include <filesystem>
#include <string>

namespace daumier::train {

/// "float32" or "bfloat16", as a training with the option `precision` (core/training.h) computes and its run stores:
///   float32, bfloat16   that one
///   force-bfloat16      bfloat16, even on a processor that is slow and inexact at it
///   auto                as the run that `run_directory` holds; bfloat16 for a new one on a processor with its
///                       instructions; float32 otherwise, GPUs included
/// `has_instructions`: HasBfloat16Instructions().
/// @throws UsageError for a bfloat16 that is not forced on a processor without its instructions.
std::string ResolvePrecision(const std::string& precision, const std::filesystem::path& run_directory,
                             const torch::Device& device, bool has_instructions);

/// The precision that a config names, seen from a stored run: `of_run` for auto, bfloat16 for force-bfloat16.
std::string PrecisionForRun(const std::string& precision, const std::string& of_run);

}  // namespace daumier::train
