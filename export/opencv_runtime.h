#pragma once
#include "export/onnx_runtime.h"

#include <filesystem>
#include <string>
#include <vector>

namespace daumier::exporting {

/// Runs a model on the CPU in OpenCV's dnn module, once for every entry of `runs`, as RunInOnnxRuntime; the network is
/// read once and takes each batch size in turn. @throws Error with OpenCV's message if the model cannot be loaded or
/// run. A model that is run may still have wrong outputs without an error: compare them (export/parity.h).
OnnxOutputs RunInOpenCv(const std::filesystem::path& model, const std::vector<tensor::NamedTensors>& runs,
                        const std::vector<std::string>& output_names);

/// "OpenCV 4.6.0".
std::string OpenCvName();

}  // namespace daumier::exporting
