#pragma once
#include "export/onnx_graph.h"
#include "tensor/tensor_file.h"

#include <map>
#include <string>
#include <unordered_map>
#include <vector>

namespace torch::jit {
struct Node;
struct Value;
}  // namespace torch::jit

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
  std::vector<std::string> Names(const torch::jit::Node& node, size_t first, size_t last);

  /// A transposed weight: some operators take the weight itself instead. Empty if the value is none.
  std::string NameBeforeTranspose(const torch::jit::Value* value);

 private:
  struct Weight {
    std::string name;
    torch::Tensor tensor;
  };
  OnnxGraph& graph_;
  std::unordered_map<const torch::jit::Value*, std::string> names_;
  std::unordered_map<const torch::jit::Value*, Weight> weights_;
};

/// Appends ONNX nodes for one node of a trace and returns the name of its output.
using LoweringFunction = std::string (*)(const torch::jit::Node& node, LoweringContext& context);

/// From LibTorch's operator ("aten::relu") to its lowering: everything that can be exported.
const std::map<std::string, LoweringFunction>& LoweringTable();

/// Lowers one node. Constants and lists of constants are read where they are used.
/// @throws Error naming the operator and showing the line of the trace if there is no lowering, or if the lowering does
/// not cover this use of it.
void LowerNode(const torch::jit::Node& node, LoweringContext& context);

}  // namespace daumier::exporting
