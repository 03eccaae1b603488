#include "export/onnx_export.h"

#include "core/error.h"
#include "export/lowering.h"
#include "tensor/module_state.h"
#include "tensor/torch_version.h"

#include <onnx/checker.h>
#include <onnx/shape_inference/implementation.h>
#include <torch/csrc/jit/frontend/tracer.h>
#include <torch/csrc/jit/ir/ir.h>
#include <torch/csrc/jit/passes/dead_code_elimination.h>
#include <algorithm>

namespace daumier::exporting {
namespace {

namespace jit = torch::jit;

struct Trace {
  std::shared_ptr<jit::Graph> graph;
  std::vector<torch::Tensor> inputs, outputs;
};

/// Weights are inputs of the trace in addition to `function`'s own, in the order of `weights`: the tracer identifies
/// tensors by address.
Trace TraceAt(int64_t batch, const ExportedFunction& function, const tensor::NamedTensors& weights) {
  at::NoGradGuard no_grad;
  Trace trace;
  jit::Stack inputs;
  std::vector<std::string> names;
  for (const ExportedInput& input : function.inputs) {
    std::vector<int64_t> shape = input.shape;
    if (input.batched) shape.insert(shape.begin(), batch);
    trace.inputs.push_back(torch::zeros(shape));
    inputs.emplace_back(trace.inputs.back());
    names.push_back(input.name);
  }
  for (const auto& [name, weight] : weights) {
    inputs.emplace_back(weight);
    names.push_back(name);
  }
  const auto run = [&](jit::Stack stack) {
    jit::Stack outputs;
    std::vector<torch::Tensor> given;
    for (size_t i = 0; i < function.inputs.size(); ++i) given.push_back(stack[i].toTensor());
    trace.outputs = function.forward(given);
    for (const auto& output : trace.outputs) outputs.emplace_back(output);
    return outputs;
  };
  const auto no_name = [](const torch::Tensor&) { return std::string(); };
  const auto traced =
      jit::tracer::trace(inputs, run, no_name, /*strict=*/true, /*force_outplace=*/true, /*self=*/nullptr, names);
  trace.graph = traced.first->graph;
  jit::EliminateDeadCode(trace.graph);
  return trace;
}

onnx::ModelProto Lower(const Trace& trace, const ExportedFunction& function, const tensor::NamedTensors& weights) {
  OnnxGraph graph(function.name);
  LoweringContext context(graph);
  const auto inputs = trace.graph->inputs();
  size_t next = 0;
  for (const ExportedInput& input : function.inputs) {
    graph.AddInput(input.name, trace.inputs[next], input.batched);
    context.SetName(inputs[next++], input.name);
  }
  // OpenCV 4.6 takes a named dimension of a matrix for a size of 0, and of images for a size of 1: they would not meet.
  const auto is_image = [](const ExportedInput& input) { return input.batched && input.shape.size() > 1; };
  if (std::any_of(function.inputs.begin(), function.inputs.end(), is_image))
    for (const ExportedInput& input : function.inputs)
      if (input.batched && !is_image(input)) graph.UnnameBatch(input.name);
  for (const auto& [name, weight] : weights) context.SetWeight(inputs[next++], name, weight);
  for (const jit::Node* node : trace.graph->nodes()) LowerNode(*node, context);

  const auto outputs = trace.graph->outputs();
  DAUMIER_CHECK(outputs.size() == function.output_names.size(), "the network has {} outputs, but {} have names",
                outputs.size(), function.output_names.size());
  for (size_t i = 0; i < outputs.size(); ++i) {
    graph.AddOutput(function.output_names[i], context.Name(outputs[i]), trace.outputs[i]);
  }
  for (const auto& [key, text] : function.metadata) graph.AddMetadata(key, text);
  return graph.model();
}

}  // namespace

onnx::ModelProto ExportToOnnx(const torch::nn::Module& module, const ExportedFunction& function) {
  DAUMIER_CHECK(!module.is_training(), "{} is in training mode; call eval() before it is exported", function.name);
  const auto weights = tensor::StateOf(module);
  auto model = Lower(TraceAt(2, function, weights), function, weights);
  const auto again = Lower(TraceAt(3, function, weights), function, weights);
  DAUMIER_CHECK(model.SerializeAsString() == again.SerializeAsString(),
                "{} was traced at batch sizes 2 and 3 and gave two graphs: an operator has the batch size baked in (a "
                "size computed from size(0), or a constant tensor of that size; size(0) itself may begin a view)",
                function.name);
  CheckOnnx(model);
  return model;
}

void CheckOnnx(const onnx::ModelProto& model) {
  try {
    onnx::checker::check_model(model);
    onnx::ModelProto inferred = model;
    const onnx::ShapeInferenceOptions strict(/*check_type=*/true, /*error_mode=*/1, /*data_propagation=*/false);
    onnx::shape_inference::InferShapes(inferred, onnx::OpSchemaRegistry::Instance(), strict);
  } catch (const std::exception& error) {
    throw Error(fmt::format("ONNX refuses the graph '{}': {}", model.graph().name(), error.what()));
  }
}

}  // namespace daumier::exporting
