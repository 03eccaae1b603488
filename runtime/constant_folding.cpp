#include "runtime/constant_folding.h"

#include "core/error.h"
#include "runtime/array_kernels.h"
#include "runtime/finite.h"
#include "runtime/folded_arithmetic.h"
#include "runtime/strided_view.h"

#include <algorithm>
#include <set>

namespace daumier::runtime {
namespace {

/// A node of which all inputs are known.
struct FoldRequest {
  const GraphNode& node;
  const std::vector<KnownInput>& inputs;
  int64_t most;  ///< Numbers of the output.

  const GraphTensor& Input(size_t input) const {
    DAUMIER_CHECK(node.Reads(input), "input {} is absent", input);
    return *inputs[input].value;
  }
  const std::vector<int64_t>& Integers(size_t input) const {
    const GraphTensor& tensor = Input(input);
    DAUMIER_CHECK(tensor.has_integers, "input {}, '{}', is not of integers", input, node.inputs[input]);
    return tensor.integers;
  }
  bool Allows(const Shape& shape) const { return CheckedSize(shape, "its output") <= most; }
};
using Folding = std::optional<GraphTensor>;

int64_t CountOf(const GraphTensor& tensor) {
  return int64_t(tensor.integers.size() + tensor.numbers.size());
}

/// The elements of `from` at these places.
GraphTensor Taken(const GraphTensor& from, Shape shape, const std::vector<int64_t>& places) {
  GraphTensor taken{.shape = std::move(shape), .has_integers = from.has_integers};
  const auto take = [&](const auto& source, auto& target) {
    target.reserve(places.size());
    for (const int64_t place : places) target.push_back(source[size_t(place)]);
  };
  if (from.has_integers) {
    take(from.integers, taken.integers);
  } else {
    take(from.numbers, taken.numbers);
  }
  return taken;
}

GraphTensor IntegerTensor(Shape shape, std::vector<int64_t> integers) {
  return {.shape = std::move(shape), .integers = std::move(integers), .has_integers = true};
}

Folding FoldShape(const FoldRequest& request) {
  DAUMIER_CHECK(!request.inputs.empty(), "it has no input");
  const Shape& shape = *request.inputs[0].shape;
  const auto rank = int64_t(shape.size());
  const auto counted = [&](int64_t at) { return std::clamp(at < 0 ? at + rank : at, int64_t{0}, rank); };
  const int64_t begin = counted(request.node.Integer("start", 0)), end = counted(request.node.Integer("end", rank));
  std::vector<int64_t> sizes;
  for (int64_t i = begin; i < end; ++i) sizes.push_back(shape[size_t(i)]);
  const auto count = int64_t(sizes.size());
  return IntegerTensor({count}, std::move(sizes));
}

Folding FoldSize(const FoldRequest& request) {
  DAUMIER_CHECK(!request.inputs.empty(), "it has no input");
  return IntegerTensor({}, {CheckedSize(*request.inputs[0].shape, "its input")});
}

Folding FoldView(const FoldRequest& request) {
  const GraphTensor& from = request.Input(0);
  const StridedView view = ViewOf(request.node, from.shape,
                                  [&](size_t input) -> const std::vector<int64_t>& { return request.Integers(input); });
  if (!request.Allows(view.shape)) return std::nullopt;
  if (LiesClose(view) && view.offset == 0 && CheckedSize(view.shape, "its output") == CountOf(from)) {
    GraphTensor same = from;
    same.shape = view.shape;
    return same;
  }
  return Taken(from, view.shape, PlacesOf(view));
}

Folding FoldConcatenation(const FoldRequest& request) {
  const GraphTensor& first = request.Input(0);
  GraphTensor joined{.shape = first.shape, .has_integers = first.has_integers};
  const size_t axis = AxisOf(request.node.Integer("axis", 0), first.shape.size());
  joined.shape[axis] = 0;
  for (size_t input = 0; input < request.inputs.size(); ++input) {
    const GraphTensor& part = request.Input(input);
    Shape rest = part.shape;
    DAUMIER_CHECK(rest.size() == first.shape.size() && part.has_integers == first.has_integers,
                  "its parts have different kinds of numbers, or {} and {} axes", first.shape.size(), rest.size());
    joined.shape[axis] += rest[axis];
    rest[axis] = first.shape[axis];
    DAUMIER_CHECK(rest == first.shape, "a part is {}, another one is {}", ShapeText(part.shape),
                  ShapeText(first.shape));
  }
  if (!request.Allows(joined.shape)) return std::nullopt;
  int64_t outer = 1, inner = 1;
  for (size_t i = 0; i < axis; ++i) outer *= joined.shape[i];
  for (size_t i = axis + 1; i < joined.shape.size(); ++i) inner *= joined.shape[i];
  for (int64_t o = 0; o < outer; ++o) {
    for (size_t input = 0; input < request.inputs.size(); ++input) {
      const GraphTensor& part = request.Input(input);
      const int64_t row = part.shape[axis] * inner;
      const auto append = [&](auto& to, const auto& from) {
        to.insert(to.end(), from.begin() + o * row, from.begin() + (o + 1) * row);
      };
      if (joined.has_integers) {
        append(joined.integers, part.integers);
      } else {
        append(joined.numbers, part.numbers);
      }
    }
  }
  return joined;
}

Folding FoldGather(const FoldRequest& request) {
  const GraphTensor& from = request.Input(0);
  const size_t axis = AxisOf(request.node.Integer("axis", 0), from.shape.size());
  const Shape& of_indices = request.Input(1).shape;
  Shape shape(from.shape.begin(), from.shape.begin() + std::ptrdiff_t(axis));
  shape.insert(shape.end(), of_indices.begin(), of_indices.end());
  shape.insert(shape.end(), from.shape.begin() + std::ptrdiff_t(axis) + 1, from.shape.end());
  if (!request.Allows(shape)) return std::nullopt;
  const std::vector<int64_t> indices = IndicesOf(request.Integers(1), from.shape[axis]);
  const int64_t inner = StridesOf(from.shape)[axis];
  int64_t outer = 1;
  for (size_t i = 0; i < axis; ++i) outer *= from.shape[i];
  std::vector<int64_t> places;
  for (int64_t o = 0; o < outer; ++o)
    for (const int64_t index : indices)
      for (int64_t i = 0; i < inner; ++i) places.push_back((o * from.shape[axis] + index) * inner + i);
  return Taken(from, shape, places);
}

Folding FoldFilled(const FoldRequest& request) {
  const Shape& shape = request.Integers(0);
  if (!request.Allows(shape)) return std::nullopt;
  const GraphTensor value = request.node.Tensor("value", {.shape = {1}, .numbers = {0}});
  DAUMIER_CHECK(value.integers.size() + value.numbers.size() == 1, "its value has {} numbers",
                value.integers.size() + value.numbers.size());
  return Taken(value, shape, std::vector<int64_t>(size_t(CheckedSize(shape, "its output")), 0));
}

Folding FoldWhere(const FoldRequest& request) {
  const GraphTensor &a = request.Input(1), &b = request.Input(2);
  const std::vector<int64_t>& choice = request.Integers(0);
  DAUMIER_CHECK(a.has_integers == b.has_integers, "it chooses between integers and other numbers");
  const Shape shape = BroadcastShape(request.Input(0).shape, BroadcastShape(a.shape, b.shape));
  if (!request.Allows(shape)) return std::nullopt;
  const auto read = [&](const Shape& from) { return PlacesOf({shape, RepeatingStrides(from, shape)}); };
  GraphTensor chosen = Taken(a, shape, read(a.shape));
  const GraphTensor otherwise = Taken(b, shape, read(b.shape));
  const std::vector<int64_t> of_choice = read(request.Input(0).shape);
  for (size_t i = 0; i < of_choice.size(); ++i) {
    if (choice[size_t(of_choice[i])] != 0) continue;
    if (a.has_integers) {
      chosen.integers[i] = otherwise.integers[i];
    } else {
      chosen.numbers[i] = otherwise.numbers[i];
    }
  }
  return chosen;
}

Folding FoldArithmetic(const FoldRequest& request) {
  const GraphTensor& a = request.Input(0);
  if (request.node.inputs.size() != 2) return FoldedUnary(request.node, a);
  const GraphTensor& b = request.Input(1);
  const Shape shape = BroadcastShape(a.shape, b.shape);
  if (!request.Allows(shape)) return std::nullopt;
  const auto as_result = [&](const GraphTensor& from) {
    return Taken(from, shape, PlacesOf({shape, RepeatingStrides(from.shape, shape)}));
  };
  return FoldedBinary(request.node.op, as_result(a), as_result(b));
}

Folding FoldRangeOfNumbers(const FoldRequest& request) {
  return FoldedRange(request.Input(0), request.Input(1), request.Input(2), request.most);
}

/// Of all numbers; along single axes of several it is left to the plan.
Folding FoldReduction(const FoldRequest& request) {
  const GraphTensor& from = request.Input(0);
  const bool names_axes = request.node.Reads(1) && !request.Integers(1).empty();
  if (from.shape.size() > 1 && (names_axes || request.node.Integer("noop_with_empty_axes", 0) != 0))
    return std::nullopt;
  GraphTensor reduced = FoldedReduction(request.node.op, from);
  if (request.node.Integer("keepdims", 1) != 0) reduced.shape.assign(from.shape.size(), 1);
  return reduced;
}

using FoldFunction = Folding (*)(const FoldRequest&);
FoldFunction FoldFunctionOf(const std::string& op) {
  static const std::map<std::string, FoldFunction> functions = [] {
    std::map<std::string, FoldFunction> all = {{"Concat", FoldConcatenation}, {"ConstantOfShape", FoldFilled},
                                               {"Gather", FoldGather},        {"Range", FoldRangeOfNumbers},
                                               {"ReduceMax", FoldReduction},  {"ReduceMin", FoldReduction},
                                               {"ReduceProd", FoldReduction}, {"ReduceSum", FoldReduction},
                                               {"Shape", FoldShape},          {"Size", FoldSize},
                                               {"Where", FoldWhere}};
    for (const std::string& name : FoldedArithmeticNames()) all[name] = FoldArithmetic;
    return all;
  }();
  if (IsViewOperator(op)) return FoldView;
  const auto found = functions.find(op);
  return found == functions.end() ? nullptr : found->second;
}

/// Whether all that the node reads is known.
bool IsKnown(const GraphNode& node, const std::vector<KnownInput>& inputs) {
  const bool needs_shape = node.op == "Shape" || node.op == "Size";
  for (size_t i = 0; i < node.inputs.size(); ++i)
    if (node.Reads(i) && (needs_shape ? inputs[i].shape == nullptr : inputs[i].value == nullptr)) return false;
  return !node.inputs.empty() && node.Reads(0);
}

}  // namespace

std::optional<GraphTensor> ConstantFolder::Fold(const GraphNode& node, const std::vector<KnownInput>& inputs) {
  const FoldFunction fold = FoldFunctionOf(node.op);
  if (fold == nullptr || !IsKnown(node, inputs)) return std::nullopt;
  int64_t read = 1;
  for (const KnownInput& input : inputs)
    if (input.value != nullptr && node.op != "Shape" && node.op != "Size") read += CountOf(*input.value);
  if (read > left_) return std::nullopt;
  left_ -= read;
  try {
    std::optional<GraphTensor> folded = fold({node, inputs, left_});
    if (!folded) return std::nullopt;
    left_ -= CountOf(*folded);
    DAUMIER_CHECK(AreFinite(folded->numbers), "its numbers are not finite");
    return folded;
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", node.Text(), error.what()));
  }
}

bool IsFoldedOperator(const std::string& op) {
  return FoldFunctionOf(op) != nullptr;
}

Graph FoldedConstants(Graph graph) {
  ConstantFolder folder;
  const std::set<std::string> outputs(graph.outputs.begin(), graph.outputs.end());
  std::vector<GraphNode> kept;
  for (GraphNode& node : graph.nodes) {
    std::vector<KnownInput> inputs;
    for (const std::string& input : node.inputs) {
      const auto found = graph.weights.find(input);
      inputs.push_back(found == graph.weights.end() ? KnownInput{} : KnownInput{&found->second.shape, &found->second});
    }
    std::optional<GraphTensor> folded;
    if (!outputs.contains(node.output)) folded = folder.Fold(node, inputs);
    if (folded) {
      graph.weights.emplace(node.output, std::move(*folded));
    } else {
      kept.push_back(std::move(node));
    }
  }
  graph.nodes = std::move(kept);
  return graph;
}

}  // namespace daumier::runtime
