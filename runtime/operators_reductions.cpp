// Sums, means, maxima, softmax.
#include "core/error.h"
#include "runtime/array_kernels.h"
#include "runtime/operators.h"

#include <algorithm>
#include <array>

namespace daumier::runtime {
namespace {

Reduction ReductionOf(const GraphNode& node) {
  static const std::map<std::string, Reduction> kinds = {{"ReduceMax", Reduction::kMax},
                                                         {"ReduceMean", Reduction::kMean},
                                                         {"ReduceMin", Reduction::kMin},
                                                         {"ReduceSum", Reduction::kSum}};
  return kinds.at(node.op);
}

/// Maxima and means of whole images in blocks are pools.
Place PoolOfImages(const GraphNode& node, const Shape& image, PlanBuilder& plan) {
  const Layout source = plan.Value(node.inputs[0]).layout;
  const Shape pooled = {image[0], image[1], 1, 1};
  const Window window{{image[2], image[3]}, {1, 1}, {1, 1}, {0, 0}, {0, 0}};
  const Primitive primitive =
      MakePool(source, AnyLayout(pooled), window, node.op == "ReduceMax" ? PoolKind::kMax : PoolKind::kMean);
  const Place to = plan.NewBuffer(SizeOf(primitive.target));
  plan.AddPrimitive(node, primitive,
                    {{DNNL_ARG_SRC, source, plan.Value(node.inputs[0]).place}, {DNNL_ARG_DST, primitive.target, to}});
  const GraphNode inner{.op = node.op, .name = node.name + "/pool", .inputs = {}, .output = node.output + "/pooled"};
  plan.Define(inner, pooled, primitive.target, to);
  return plan.Plain(inner.output);
}

void PlanReduction(const GraphNode& node, PlanBuilder& plan) {
  const Shape from = plan.ShapeOf(node.inputs.at(0));
  const std::vector<int64_t> axes = node.Reads(1) ? plan.Integers(node, 1) : node.Integers("axes", {});
  std::vector<bool> is_reduced(from.size(), axes.empty() && node.Integer("noop_with_empty_axes", 0) == 0);
  for (const int64_t axis : axes) is_reduced[AxisOf(axis, from.size())] = true;
  const bool keeps = node.Integer("keepdims", 1) != 0;
  const std::vector<int64_t> strides = StridesOf(from);
  Shape shape, kept, reduced;
  std::vector<int64_t> kept_strides, reduced_strides;
  for (size_t i = 0; i < from.size(); ++i) {
    (is_reduced[i] ? reduced : kept).push_back(from[i]);
    (is_reduced[i] ? reduced_strides : kept_strides).push_back(strides[i]);
    if (!is_reduced[i] || keeps) shape.push_back(is_reduced[i] ? 1 : from[i]);
  }
  const bool of_images = is_reduced == std::vector<bool>{false, false, true, true};
  if (of_images && (node.op == "ReduceMax" || node.op == "ReduceMean") &&
      BlockOf(plan.Value(node.inputs[0]).layout, from) > 1)
    return plan.Define(node, shape, PlainLayout(shape), PoolOfImages(node, from, plan));
  const Place source = plan.Plain(node.inputs[0]), to = plan.NewOutput(node, shape, PlainLayout(shape));
  plan.AddOwn(node, std::array{source, to},
              [=, reduction = StridedReduction(ReductionOf(node), kept, kept_strides, reduced, reduced_strides)](
                  Arena& arena) { reduction.Run(arena.At(source), arena.At(to)); });
  plan.Define(node, shape, PlainLayout(shape), to);
}

void PlanSoftmax(const GraphNode& node, PlanBuilder& plan) {
  const Shape shape = plan.ShapeOf(node.inputs.at(0));
  const size_t axis = AxisOf(node.Integer("axis", -1), shape.size());
  int64_t outer = 1, inner = 1;
  for (size_t i = 0; i < shape.size(); ++i) {
    if (i < axis) outer *= shape[i];
    if (i > axis) inner *= shape[i];
  }
  const bool flattens = node.Integer("flattens", 0) != 0;  // All axes from `axis` on are one.
  const int64_t size = flattens ? shape[axis] * inner : shape[axis];
  if (flattens) inner = 1;
  const Place from = plan.Plain(node.inputs[0]), to = plan.NewOutput(node, shape, PlainLayout(shape));
  plan.AddOwn(node, std::array{from, to}, [=, logarithm = node.op == "LogSoftmax"](Arena& arena) {
    SoftmaxOf(arena.At(from), outer, size, inner, logarithm, arena.At(to));
  });
  plan.Define(node, shape, PlainLayout(shape), to);
}

}  // namespace

OperatorTable ReductionOperators() {
  return {{"LogSoftmax", PlanSoftmax},  {"ReduceMax", PlanReduction}, {"ReduceMean", PlanReduction},
          {"ReduceMin", PlanReduction}, {"ReduceSum", PlanReduction}, {"Softmax", PlanSoftmax}};
}

}  // namespace daumier::runtime
