#pragma once
#include "runtime/constant_folding.h"
#include "runtime/plan.h"

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace daumier::runtime {

/// A tensor of the graph in a plan.
struct PlannedValue {
  Shape shape;
  Layout layout;
  Place place;
};

/// Weights in the layouts of primitives, which plans of one graph share. Not thread-safe.
class PackedWeights {
 public:
  /// The numbers of `weights`, which lie in `from`, in the layout `to`. They live as long as this object.
  const float* Packed(const std::string& name, const float* weights, const Layout& from, const Layout& to);

 private:
  struct Entry {
    Layout layout;
    AlignedFloats numbers;
  };
  std::map<std::string, std::vector<std::unique_ptr<Entry>>> entries_;
};

/// Makes a plan node by node. What depends on shapes and weights alone is computed at once (runtime/constant_folding.h);
/// the rest becomes steps. An operator (runtime/operators.h) requests its inputs in the layout that it reads, adds
/// steps and defines its output. A shape without sizes of 0 is promised to operators.
class PlanBuilder {
 public:
  /// The graph and the packed weights outlive the plan.
  PlanBuilder(const Graph& graph, const std::map<std::string, Shape>& inputs, PackedWeights& packed);

  /// The plan of the whole graph. @throws Error naming the node and the cause.
  std::unique_ptr<Plan> Build();

  /// Values, by names of the graph.
  const PlannedValue& Value(const std::string& name) const;
  const Shape& ShapeOf(const std::string& name) const { return Value(name).shape; }
  /// Weights, and what is computed from shapes. @throws Error naming the node if the input depends on the graph's
  /// inputs, or is of the other kind of numbers.
  const GraphTensor& Weight(const GraphNode& node, size_t input) const;
  const std::vector<int64_t>& Integers(const GraphNode& node, size_t input) const {
    return Whole(node, input).integers;
  }
  const Shape& ShapeOfIntegers(const GraphNode& node, size_t input) const { return Whole(node, input).shape; }

  /// Where the value lies in that layout; adds a step that converts it if there is none yet.
  Place In(const std::string& name, const Layout& layout);
  Place Plain(const std::string& name) { return In(name, PlainLayout(ShapeOf(name))); }
  /// A weight of the graph in the layout of a primitive. `from`: how the primitive sees the stored numbers.
  Place Packed(const GraphNode& node, size_t input, const Layout& from, const Layout& to);

  /// Whether no later node reads the memory of an input of the present node.
  bool MayOverwrite(const std::string& name) const;

  /// New memory for the output of a node: of a part of a concatenation its place in there, if it may lie there.
  Place NewOutput(const GraphNode& node, const Shape& shape, const Layout& layout);
  /// Memory in layouts that hold `size` numbers, padding included.
  Place NewBuffer(int64_t size);
  void Define(const GraphNode& node, const Shape& shape, const Layout& layout, const Place& place);

  /// arguments: those with places; scratch memory is added.
  void AddPrimitive(const GraphNode& node, const Primitive& primitive, std::vector<PlanArgument> arguments);
  void AddOwn(const GraphNode& node, std::span<const Place> places, std::function<void(Arena&)> own);
  /// Copies numbers, in the layouts that they have, if the places differ.
  void AddCopy(const GraphNode& node, const Place& from, const Place& to, int64_t count);

  /// Of the parts of the concatenation `output`: the place that their numbers share, and its block, if one part lies
  /// there.
  struct Gathering {
    Place place;
    int block = 0;
  };
  std::optional<Gathering> GatheringOf(const std::string& output) const;
  /// The place, whose buffer now holds at least `size` numbers.
  Place Grown(const Place& place, int64_t size);

 private:
  /// A value that a concatenation reads.
  struct Part {
    const GraphNode* concatenation;
    size_t index;
  };
  void FindParts();
  std::optional<Place> PlaceInGathering(const GraphNode& node, const Shape& shape, const Layout& layout);
  void Touch(const Place& place);
  void PlanNode(const GraphNode& node);
  /// Whether the node's output is known without a run; it is then defined.
  bool FoldNode(const GraphNode& node);
  const GraphTensor* Known(const std::string& name) const;
  const GraphTensor& Whole(const GraphNode& node, size_t input) const;

  const Graph& graph_;
  PackedWeights& packed_;
  ConstantFolder folder_;
  std::map<std::string, GraphTensor> folded_;
  std::map<std::string, PlannedValue> values_;
  std::map<std::string, int> reads_;  ///< Of each value, by nodes that are still to be planned, and outputs.
  std::map<int, int> reads_of_buffers_;
  std::map<std::string, std::vector<std::pair<Layout, Place>>> converted_;
  std::map<std::string, Part> parts_;
  std::map<std::string, Gathering> gatherings_;
  std::vector<PlanStep> steps_;
  std::vector<PlanPort> inputs_;
  std::vector<PlanBuffer> buffers_;
};

/// The numbers that a layout takes, padding included.
int64_t SizeOf(const Layout& layout);

}  // namespace daumier::runtime
