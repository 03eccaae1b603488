#pragma once
#include "export/lowering_arguments.h"
#include "export/onnx_graph.h"
#include "tensor/tensor_file.h"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace daumier::exporting {

/// State of a lowering: the ONNX value of each value of the trace. Weights enter the graph when they are
/// first used.
class LoweringContext {
 public:
  explicit LoweringContext(OnnxGraph& graph) : graph_(graph) {}

  OnnxGraph& graph() { return graph_; }

  /// Called before the nodes are lowered: the value is an input of the graph, or a weight.
  void SetName(const torch::jit::Value* value, const std::string& name) { names_[value] = name; }
  void SetWeight(const torch::jit::Value* value, const std::string& name, const torch::Tensor& weight);

  /// The name of an input in the ONNX graph. @throws Error if the value is of no kind that ONNX has.
  std::string Name(const torch::jit::Value* value);
  /// Names of all inputs from `first` on, without the absent ones.
  std::vector<std::string> Names(const Arguments& in, size_t first, size_t last);

  /// A transposed weight: some operators take the weight itself instead. Empty if the value is none.
  std::string NameBeforeTranspose(const torch::jit::Value* value);

  /// The tensor of a weight, of a constant tensor, or of what was computed from these alone.
  std::optional<torch::Tensor> Weight(const torch::jit::Value* value) const;

  /// Appends a reshape to `shape`, whose dimension 0 is left free.
  std::string Reshaped(const std::string& name, std::vector<int64_t> shape);

  /// Evaluates a node that reads constants and weights alone; its output becomes a weight. False if it reads more.
  bool Fold(const torch::jit::Node& node);

 private:
  struct NamedWeight {
    std::string name;
    torch::Tensor tensor;
  };
  OnnxGraph& graph_;
  std::unordered_map<const torch::jit::Value*, std::string> names_;
  std::unordered_map<const torch::jit::Value*, NamedWeight> weights_;
};

/// Appends ONNX nodes for one node of a trace and returns the name of its output.
using LoweringFunction = std::function<std::string(const Arguments& in, LoweringContext& context)>;
/// By LibTorch's operators: "aten::relu".
using Lowerings = std::map<std::string, LoweringFunction>;

/// Everything that can be exported. Where ONNX has several forms of an operator, the lowerings write the one that
/// OpenCV 4.6 computes rightly, too (tests/export/opencv_runtime_test.cpp).
const Lowerings& LoweringTable();

/// The parts of the table.
Lowerings LayerLowerings();      ///< Convolutions, normalisation, products of matrices, dropout.
Lowerings ImageLowerings();      ///< Pooling and resizing.
Lowerings PointwiseLowerings();  ///< Activations, arithmetic.
Lowerings ShapeLowerings();      ///< Views, concatenation, parts, padding.
Lowerings ReductionLowerings();  ///< Sums, means, maxima, softmax.

/// Lowers one node. Constants and lists of constants are read where they are used.
/// @throws Error naming the operator and showing the line of the trace if there is no lowering, or if the lowering does
/// not cover this use of it.
void LowerNode(const torch::jit::Node& node, LoweringContext& context);

}  // namespace daumier::exporting
