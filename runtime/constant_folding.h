#pragma once
#include "runtime/graph.h"

#include <optional>

namespace daumier::runtime {

/// What is known of a node's input before a run; null where it is not, or where the input is absent.
struct KnownInput {
  const Shape* shape = nullptr;
  const GraphTensor* value = nullptr;
};

/// Computes what depends on shapes and weights alone: sizes of later nodes, mostly. Shapes are known when a plan is made,
/// weights before. All operators of shapes and whole numbers that are run here exist in this form alone
/// (docs/runtime.md), those of real numbers also as steps of a plan.
class ConstantFolder {
 public:
  /// Numbers that a folder reads and writes at most; what exceeds them is left to the plan.
  static constexpr int64_t kMostFolded = int64_t{1} << 25;

  /// The node's output, or nothing where an input is not known, the operator is not one of these, or too much is
  /// computed. Whole numbers do not wrap around. @throws Error naming the node and the cause if the node is not as ONNX
  /// demands, overflows, divides whole numbers by 0, or gives numbers that are not finite.
  std::optional<GraphTensor> Fold(const GraphNode& node, const std::vector<KnownInput>& inputs);

 private:
  int64_t left_ = kMostFolded;
};

/// Whether there is a node of this operator that Fold computes.
bool IsFoldedOperator(const std::string& op);

/// The graph whose nodes that depend on weights alone are weights. The graph has passed CheckGraph.
Graph FoldedConstants(Graph graph);

}  // namespace daumier::runtime
