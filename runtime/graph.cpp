#include "runtime/graph.h"

#include "core/error.h"
#include "runtime/finite.h"

#include <fmt/ranges.h>

#include <set>

namespace daumier::runtime {
namespace {

template <class T>
T AttributeOf(const GraphNode& node, const std::string& name, const T& otherwise) {
  const auto found = node.attributes.find(name);
  if (found == node.attributes.end()) return otherwise;
  const T* const value = std::get_if<T>(&found->second);
  DAUMIER_CHECK(value != nullptr, "{}: the attribute '{}' is of another type", node.Text(), name);
  return *value;
}

void CheckWeight(const std::string& name, const GraphTensor& weight) {
  const int64_t size = CheckedSize(weight.shape, fmt::format("the tensor '{}'", name));
  const size_t found = weight.has_integers ? weight.integers.size() : weight.numbers.size();
  DAUMIER_CHECK(int64_t(found) == size, "the tensor '{}' has {} numbers, expected {} for the shape {}", name, found,
                size, ShapeText(weight.shape));
  DAUMIER_CHECK(AreFinite(weight.numbers), "the tensor '{}' has numbers that are not finite", name);
}

}  // namespace

int64_t GraphNode::Integer(const std::string& attribute, int64_t otherwise) const {
  return AttributeOf(*this, attribute, otherwise);
}
float GraphNode::Real(const std::string& attribute, float otherwise) const {
  return AttributeOf(*this, attribute, otherwise);
}
std::string GraphNode::Text(const std::string& attribute, const std::string& otherwise) const {
  return AttributeOf(*this, attribute, otherwise);
}
std::vector<int64_t> GraphNode::Integers(const std::string& attribute, const std::vector<int64_t>& otherwise) const {
  return AttributeOf(*this, attribute, otherwise);
}
GraphTensor GraphNode::Tensor(const std::string& attribute, const GraphTensor& otherwise) const {
  return AttributeOf(*this, attribute, otherwise);
}
std::string GraphNode::Text() const {
  return fmt::format("node '{}' ({})", name, op);
}

std::string ShapeText(const Shape& shape) {
  return fmt::format("({})", fmt::join(shape, ", "));
}

int64_t CheckedSize(const Shape& shape, const std::string& what) {
  DAUMIER_CHECK(shape.size() <= kMostDimensions, "{} has {} dimensions (at most {} are read)", what, shape.size(),
                kMostDimensions);
  int64_t product = 1;
  for (const int64_t size : shape) {
    DAUMIER_CHECK(size >= 0, "{} has the shape {}", what, ShapeText(shape));
    DAUMIER_CHECK(size == 0 || product <= kMostNumbers / size, "{} has the shape {} (at most {} numbers are read)",
                  what, ShapeText(shape), kMostNumbers);
    product *= size;
  }
  return product;
}

void CheckGraph(const Graph& graph) {
  DAUMIER_CHECK(graph.nodes.size() <= kMostNodes, "the graph has {} nodes (at most {} are read)", graph.nodes.size(),
                kMostNodes);
  DAUMIER_CHECK(!graph.inputs.empty() && !graph.outputs.empty(), "the graph has {} inputs and {} outputs",
                graph.inputs.size(), graph.outputs.size());
  std::set<std::string> known;
  const auto add = [&](const std::string& name) {
    DAUMIER_CHECK(!name.empty() && known.insert(name).second, "the name '{}' is given to two tensors, or empty", name);
  };
  for (const auto& [name, weight] : graph.weights) {
    CheckWeight(name, weight);
    add(name);
  }
  for (const GraphInput& input : graph.inputs) add(input.name);
  for (const GraphNode& node : graph.nodes) {
    DAUMIER_CHECK(!node.inputs.empty(), "{} has no input", node.Text());
    for (const std::string& input : node.inputs)
      DAUMIER_CHECK(input.empty() || known.contains(input), "{} reads '{}', which no earlier node computes",
                    node.Text(), input);
    add(node.output);
  }
  for (const std::string& output : graph.outputs)
    DAUMIER_CHECK(known.contains(output) && !graph.weights.contains(output), "no node computes the output '{}'",
                  output);
}

}  // namespace daumier::runtime
