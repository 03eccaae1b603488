// Views, concatenation, parts, padding.
#include "core/error.h"
#include "export/lowering.h"

#include <torch/csrc/jit/ir/ir.h>
#include <torch/types.h>

#include <algorithm>
#include <numeric>

namespace daumier::exporting {
namespace {

std::string AddReshape(const std::string& name, const std::vector<int64_t>& shape, LoweringContext& context) {
  return context.graph().AddNode("Reshape", {name, context.graph().AddIntegers(shape)});
}

/// A leading size that is the input's own, the batch, is written as 0, which copies it.
LoweringFunction Reshape(const std::string& shape_argument) {
  return [shape_argument](const Arguments& in, LoweringContext& context) {
    auto shape = in.Integers(shape_argument);
    if (!shape.empty() && !in.Shape(0).empty() && shape[0] == in.Shape(0)[0]) shape[0] = 0;
    return AddReshape(context.Name(in.value(0)), shape, context);
  };
}

std::string LowerFlatten(const Arguments& in, LoweringContext& context) {
  const auto shape = in.Shape(0);
  const auto rank = static_cast<int64_t>(shape.size());
  const int64_t first = in.Axis("start_dim", rank), last = in.Axis("end_dim", rank);
  const std::string x = context.Name(in.value(0));
  if (first == 1 && last == rank - 1) return context.graph().AddNode("Flatten", {x}, {{"axis", int64_t{1}}});
  std::vector<int64_t> flat;
  for (int64_t i = 0; i < first; ++i) flat.push_back(i == 0 ? 0 : shape[size_t(i)]);
  flat.push_back(-1);
  for (int64_t i = last + 1; i < rank; ++i) flat.push_back(shape[size_t(i)]);
  return AddReshape(x, flat, context);
}

std::string LowerUnflatten(const Arguments& in, LoweringContext& context) {
  auto shape = in.OutputShape();
  DAUMIER_CHECK(in.Axis("dim", int64_t(in.Shape(0).size())) > 0, "the batch cannot be divided");
  shape[0] = 0;
  return AddReshape(context.Name(in.value(0)), shape, context);
}

std::string LowerSwap(const Arguments& in, LoweringContext& context) {
  const auto rank = static_cast<int64_t>(in.Shape(0).size());
  std::vector<int64_t> order(static_cast<size_t>(rank));
  std::iota(order.begin(), order.end(), 0);
  std::swap(order[size_t(in.Axis("dim0", rank))], order[size_t(in.Axis("dim1", rank))]);
  return context.graph().AddNode("Transpose", {context.Name(in.value(0))}, {{"perm", order}});
}

std::string LowerPermute(const Arguments& in, LoweringContext& context) {
  auto order = in.Integers("dims");
  for (int64_t& axis : order)
    if (axis < 0) axis += int64_t(order.size());
  return context.graph().AddNode("Transpose", {context.Name(in.value(0))}, {{"perm", order}});
}

std::string AddSlice(const Arguments& in, LoweringContext& context, int64_t axis, int64_t begin, int64_t end,
                     int64_t step) {
  OnnxGraph& graph = context.graph();
  std::vector<std::string> inputs = {context.Name(in.value(0)), graph.AddIntegers({begin}), graph.AddIntegers({end}),
                                     graph.AddIntegers({axis})};
  if (step != 1) inputs.push_back(graph.AddIntegers({step}));
  return graph.AddNode("Slice", inputs);
}

int64_t DimensionAxis(const Arguments& in) {
  return in.Axis("dim", int64_t(in.Shape(0).size()));
}

std::string LowerNarrow(const Arguments& in, LoweringContext& context) {
  const int64_t begin = in.Integer("start");
  return AddSlice(in, context, DimensionAxis(in), begin, begin + in.Integer("length"), 1);
}

std::string LowerSlice(const Arguments& in, LoweringContext& context) {
  const int64_t axis = DimensionAxis(in), size = in.Shape(0)[size_t(axis)];
  int64_t begin = in.IsAbsent("start") ? 0 : in.Integer("start");
  const int64_t end = in.IsAbsent("end") ? size : in.Integer("end"), step = in.Integer("step");
  const bool is_whole = begin == 0 && end >= size && step == 1;
  if (is_whole) return context.Name(in.value(0));  // x.slice(0), of the batch for instance.
  return AddSlice(in, context, axis, begin, end, step);
}

std::string LowerSelect(const Arguments& in, LoweringContext& context) {
  const int64_t axis = DimensionAxis(in), index = in.Integer("index");
  DAUMIER_CHECK(axis > 0, "it takes one sample out of the batch");
  const int64_t begin = index < 0 ? index + in.Shape(0)[size_t(axis)] : index;
  return context.Reshaped(AddSlice(in, context, axis, begin, begin + 1, 1), in.OutputShape());
}

/// Axes of size 1, given or all. The batch has another size in a trace: axis 0 is one of an input without a batch.
std::string LowerSqueeze(const Arguments& in, LoweringContext& context) {
  const auto shape = in.Shape(0);
  const std::string x = context.Name(in.value(0));
  std::vector<int64_t> axes;
  for (const int64_t axis : in.Axes("dim", int64_t(shape.size())))
    if (shape[size_t(axis)] == 1) axes.push_back(axis);
  if (axes.empty()) return x;
  if (axes[0] == 0) return context.graph().AddNode("Squeeze", {x, context.graph().AddIntegers(axes)});
  return context.Reshaped(x, in.OutputShape());  // OpenCV 4.6 has no Squeeze whose axes are an input.
}

/// The axis counts in the result. OpenCV 4.6 inserts a second axis into a batch of more than one.
std::string LowerUnsqueeze(const Arguments& in, LoweringContext& context) {
  const int64_t axis = in.Axis("dim", int64_t(in.Shape(0).size()) + 1);
  if (axis > 0) return context.Reshaped(context.Name(in.value(0)), in.OutputShape());
  return context.graph().AddNode("Unsqueeze", {context.Name(in.value(0)), context.graph().AddIntegers({axis})});
}

std::vector<const torch::jit::Value*> Parts(const Arguments& in) {
  const torch::jit::Node& list = *in.value(0)->node();
  DAUMIER_CHECK(list.kind() == c10::prim::ListConstruct, "its parts are no list that the trace shows");
  return {list.inputs().begin(), list.inputs().end()};
}

std::string LowerConcatenation(const Arguments& in, LoweringContext& context) {
  std::vector<std::string> names;
  for (const auto* part : Parts(in)) names.push_back(context.Name(part));
  return context.graph().AddNode("Concat", names, {{"axis", in.Axis("dim", int64_t(in.OutputShape().size()))}});
}

std::string LowerStack(const Arguments& in, LoweringContext& context) {
  OnnxGraph& graph = context.graph();
  const int64_t axis = in.Axis("dim", int64_t(in.OutputShape().size()));
  DAUMIER_CHECK(axis > 0, "the batch cannot be stacked");
  auto shape = in.OutputShape();
  shape[size_t(axis)] = 1;
  std::vector<std::string> names;
  for (const auto* part : Parts(in)) names.push_back(context.Reshaped(context.Name(part), shape));
  return graph.AddNode("Concat", names, {{"axis", axis}});
}

/// Nothing where only arithmetic reads it, which repeats by itself.
std::string LowerExpand(const Arguments& in, LoweringContext& context) {
  const torch::jit::Value* output = in.node().output();
  const std::string x = context.Name(in.value(0));
  const auto from = in.Shape(0), to = in.OutputShape();
  if (IsReadByArithmeticAlone(output)) {
    if (const auto weight = context.Weight(in.value(0)); weight.has_value()) context.SetWeight(output, x, *weight);
    return x;
  }
  if (from == to) return x;
  std::vector<int64_t> factors = to;  // 1 keeps the input's size.
  for (size_t i = 0; i < from.size(); ++i) {
    const size_t axis = to.size() - from.size() + i;
    if (from[i] == to[axis]) factors[axis] = 1;
  }
  return context.graph().AddNode("Expand", {x, context.graph().AddIntegers(factors)});
}

std::string AddPad(const Arguments& in, LoweringContext& context, const std::string& mode, double value) {
  const auto given = in.Integers("pad");  // Pairs from the last axis on.
  const size_t rank = in.Shape(0).size();
  std::vector<int64_t> pads(2 * rank, 0);
  for (size_t i = 0; i < given.size() / 2; ++i) {
    pads[rank - 1 - i] = given[2 * i];
    pads[2 * rank - 1 - i] = given[2 * i + 1];
  }
  OnnxGraph& graph = context.graph();
  std::vector<std::string> inputs = {context.Name(in.value(0)), graph.AddIntegers(pads)};
  if (value != 0) inputs.push_back(graph.AddConstant(torch::tensor(static_cast<float>(value))));
  return graph.AddNode("Pad", inputs, {{"mode", mode}});
}

std::string LowerConstantPad(const Arguments& in, LoweringContext& context) {
  return AddPad(in, context, "constant", in.Real("value"));
}

std::string LowerPad(const Arguments& in, LoweringContext& context) {
  const int64_t mode = in.Integer("mode");
  const std::map<int64_t, std::string> names = {{0, "reflect"}, {1, "edge"}, {3, "constant"}};  // 2 is circular.
  DAUMIER_CHECK(names.count(mode) == 1, "circular padding has no lowering");
  return AddPad(in, context, names.at(mode), in.IsAbsent("value") ? 0 : in.Real("value"));
}

std::string LowerIdentity(const Arguments& in, LoweringContext& context) {
  const auto type = in.node().output()->type()->expect<c10::TensorType>()->scalarType();
  DAUMIER_CHECK(type == torch::kFloat32, "the result is not float32");
  return context.Name(in.value(0));
}

}  // namespace

Lowerings ShapeLowerings() {
  return {
      {"aten::_pad_enum", LowerPad},       {"aten::cat", LowerConcatenation},
      {"aten::clone", LowerIdentity},      {"aten::constant_pad_nd", LowerConstantPad},
      {"aten::contiguous", LowerIdentity}, {"aten::detach", LowerIdentity},
      {"aten::expand", LowerExpand},       {"aten::expand_as", LowerExpand},
      {"aten::flatten", LowerFlatten},     {"aten::narrow", LowerNarrow},
      {"aten::permute", LowerPermute},     {"aten::reshape", Reshape("shape")},
      {"aten::select", LowerSelect},       {"aten::slice", LowerSlice},
      {"aten::squeeze", LowerSqueeze},     {"aten::stack", LowerStack},
      {"aten::to", LowerIdentity},         {"aten::transpose", LowerSwap},
      {"aten::unflatten", LowerUnflatten}, {"aten::unsqueeze", LowerUnsqueeze},
      {"aten::view", Reshape("size")},
  };
}

}  // namespace daumier::exporting
