#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <variant>
#include <vector>

/// A trained network as data: the part of ONNX that our exporter writes (export/lowering.h) and that networks from images
/// to images have (docs/runtime.md). Operators are in the form of operator set 13 (runtime/operator_sets.h).
namespace daumier::runtime {

using Shape = std::vector<int64_t>;

/// Numbers that do not depend on the inputs: float32, or integers such as shapes and axes. Row-major.
struct GraphTensor {
  Shape shape = {};
  std::vector<float> numbers = {};
  std::vector<int64_t> integers = {};  ///< Of a tensor of integers, which has no numbers.
  bool has_integers = false;
};

using GraphAttribute = std::variant<int64_t, float, std::vector<int64_t>, std::string, std::vector<float>, GraphTensor>;

/// An operator of ONNX with one output. An input of the name "" is absent.
struct GraphNode {
  std::string op, name;
  std::vector<std::string> inputs;
  std::string output;
  std::map<std::string, GraphAttribute> attributes;

  bool Reads(size_t input) const { return input < inputs.size() && !inputs[input].empty(); }
  bool Has(const std::string& attribute) const { return attributes.contains(attribute); }
  /// Attributes, or the default of an absent one. @throws Error naming the node if an attribute is of another type.
  int64_t Integer(const std::string& attribute, int64_t otherwise) const;
  float Real(const std::string& attribute, float otherwise) const;
  std::string Text(const std::string& attribute, const std::string& otherwise) const;
  std::vector<int64_t> Integers(const std::string& attribute, const std::vector<int64_t>& otherwise) const;
  GraphTensor Tensor(const std::string& attribute, const GraphTensor& otherwise) const;
  /// "node 'Conv_3' (Conv)", for messages.
  std::string Text() const;
};

/// An input, given in float32; -1 is a size that is free.
struct GraphInput {
  std::string name;
  Shape shape;
  bool is_bytes = false;  ///< The file says uint8: whole numbers from 0 to 255.
};

/// Nodes are in an order in which they can be computed.
struct Graph {
  std::string name;
  std::vector<GraphInput> inputs;
  std::vector<std::string> outputs;
  std::vector<GraphNode> nodes;
  std::map<std::string, GraphTensor> weights;
};

/// Largest sizes of a graph: nodes; numbers of one tensor; dimensions of a tensor.
inline constexpr size_t kMostNodes = 10000;
inline constexpr int64_t kMostNumbers = int64_t{1} << 28;
inline constexpr size_t kMostDimensions = 8;

/// The product of a shape. @throws Error naming `what` if a size is negative, or if one of the limits is exceeded.
int64_t CheckedSize(const Shape& shape, const std::string& what);

/// "(1, 3, 128, 128)"
std::string ShapeText(const Shape& shape);

/// @throws Error naming the tensor or node and the cause: a name that is given twice, a node that reads what no earlier
/// one computes (cycles among them), an output that is missing, a weight whose numbers do not fill its shape or are not
/// finite, and limits that are exceeded.
void CheckGraph(const Graph& graph);

}  // namespace daumier::runtime
