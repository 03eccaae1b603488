#pragma once
#include "tensor/tensor_file.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace daumier::exporting {

struct OnnxOutputs {
  std::string runtime;                        ///< Name and version: "onnxruntime-node 1.30.0".
  std::vector<tensor::NamedTensors> outputs;  ///< One a run.
  std::vector<double> milliseconds = {};      ///< Median time of each run; empty unless runs were timed.
};

/// Runs a model on the CPU in ONNX Runtime, once for every entry of `runs` (input name -> float32 tensor): natively
/// where Daumier was built with it, else in a child process by Node.js and the npm package onnxruntime-node, with files
/// in `scratch`. The package is looked for in $DAUMIER_NPM, else in tools/npm of the nearest folder above the program
/// that has it. With `timed_runs` every run is repeated so often after a first time. Nothing where there is neither.
/// @throws Error with ONNX Runtime's message if the model cannot be loaded or run.
std::optional<OnnxOutputs> RunInOnnxRuntime(const std::filesystem::path& model,
                                            const std::vector<tensor::NamedTensors>& runs,
                                            const std::vector<std::string>& output_names,
                                            const std::filesystem::path& scratch, int timed_runs = 0);

}  // namespace daumier::exporting
