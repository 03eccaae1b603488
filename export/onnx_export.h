#pragma once
#include "export/exported_function.h"
#include "export/onnx_graph.h"

#include <torch/nn/module.h>

namespace daumier::exporting {

/// Traces `function`, which uses the parameters and buffers of `module`, and lowers the trace to ONNX (opset kOpset).
/// Parameters and buffers that are used become initializers under their own names; dimension 0 of inputs and outputs is
/// free. The model has passed the checker and strict shape inference, and is the same at two batch sizes.
/// @throws Error naming the operator and its line if it has no lowering, or if the batch size is baked into the graph;
/// and if the module is in training mode.
onnx::ModelProto ExportToOnnx(const torch::nn::Module& module, const ExportedFunction& function);

/// @throws Error with ONNX's own message if the checker or strict shape inference refuses the model.
void CheckOnnx(const onnx::ModelProto& model);

}  // namespace daumier::exporting
