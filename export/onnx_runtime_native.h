#pragma once
#include "export/onnx_runtime.h"

namespace daumier::exporting {

/// Whether Daumier was built with the C++ API of ONNX Runtime (libonnxruntime-dev of Debian 13).
bool HasNativeOnnxRuntime();

/// As RunInOnnxRuntime, in this process. @throws Error if this build has no native ONNX Runtime.
OnnxOutputs RunInNativeOnnxRuntime(const std::filesystem::path& model, const std::vector<tensor::NamedTensors>& runs,
                                   const std::vector<std::string>& output_names, int timed_runs = 0);

}  // namespace daumier::exporting
