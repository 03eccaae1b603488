// Pools.
#include "core/error.h"
#include "runtime/operators.h"

#include <algorithm>

namespace daumier::runtime {
namespace {

void AddPool(const GraphNode& node, const Shape& image, const Window& window, PoolKind kind, PlanBuilder& plan) {
  for (size_t i = 0; i < 2; ++i)
    DAUMIER_CHECK(std::max(window.before[i], window.after[i]) < window.kernel[i],
                  "its padding is not smaller than its kernel");
  const Shape shape = WindowOutput(image, image[1], window);
  const Layout source = plan.Value(node.inputs[0]).layout;
  const Primitive primitive = MakePool(source, AnyLayout(shape), window, kind);
  const Place from = plan.In(node.inputs[0], source), to = plan.NewOutput(node, shape, primitive.target);
  plan.AddPrimitive(node, primitive, {{DNNL_ARG_SRC, source, from}, {DNNL_ARG_DST, primitive.target, to}});
  plan.Define(node, shape, primitive.target, to);
}

Window PoolWindow(const GraphNode& node, const Shape& image) {
  const std::vector<int64_t> kernel = node.Integers("kernel_shape", {});
  DAUMIER_CHECK(kernel.size() == 2 && node.Integer("ceil_mode", 0) == 0 && node.Integer("storage_order", 0) == 0,
                "expected a kernel_shape of two numbers, ceil_mode 0 and storage_order 0");
  return WindowOf(node, kernel, image);
}

void PlanMaxPool(const GraphNode& node, PlanBuilder& plan) {
  const Shape image = ImageOf(node, plan);
  AddPool(node, image, PoolWindow(node, image), PoolKind::kMax, plan);
}

void PlanAveragePool(const GraphNode& node, PlanBuilder& plan) {
  const Shape image = ImageOf(node, plan);
  const PoolKind kind = node.Integer("count_include_pad", 0) == 0 ? PoolKind::kMean : PoolKind::kMeanWithPadding;
  AddPool(node, image, PoolWindow(node, image), kind, plan);
}

void PlanGlobalPool(const GraphNode& node, PlanBuilder& plan) {
  const Shape image = ImageOf(node, plan);
  const PoolKind kind = node.op == "GlobalMaxPool" ? PoolKind::kMax : PoolKind::kMean;
  AddPool(node, image, {{image[2], image[3]}, {1, 1}, {1, 1}, {0, 0}, {0, 0}}, kind, plan);
}

}  // namespace

Shape ImageOf(const GraphNode& node, const PlanBuilder& plan) {
  const Shape& image = plan.ShapeOf(node.inputs.at(0));
  DAUMIER_CHECK(image.size() == 4, "the image is {}, expected (N, C, H, W)", ShapeText(image));
  return image;
}

OperatorTable ImageOperators() {
  return {{"AveragePool", PlanAveragePool},
          {"GlobalAveragePool", PlanGlobalPool},
          {"GlobalMaxPool", PlanGlobalPool},
          {"MaxPool", PlanMaxPool}};
}

}  // namespace daumier::runtime
