#pragma once
#include "runtime/graph.h"

namespace daumier::runtime {

/// ONNX's own operator sets that are read.
inline constexpr int64_t kFirstOperatorSet = 9, kLastOperatorSet = 21;

/// A node as a file of ONNX has it: with several outputs, in the form of its operator set.
struct StoredNode {
  GraphNode node;
  std::vector<std::string> outputs;
};

/// Appends a node to a graph in the form that our operators read:
/// - numbers that later sets have as inputs are inputs: pads, axes, bounds of Clip, parts of Slice and Split;
/// - Constant becomes a weight, Dropout an Identity, Upsample a Resize;
/// - Split becomes a node for each output, with `part` and `parts`; Sum, Max and Min of many become nodes of two inputs;
/// - Softmax before set 13 has `flattens`, GroupNormalization before set 21 `scales_groups`;
/// - outputs of training are dropped (Dropout, BatchNormalization and so on).
/// @throws Error naming the node: several outputs of another operator, a norm in the form of training, an attribute of
/// another type, or more nodes than kMostNodes.
void AddNode(StoredNode stored, int64_t operator_set, Graph& graph);

}  // namespace daumier::runtime
