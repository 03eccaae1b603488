#include "runtime/operators.h"

#include "core/error.h"

#include <algorithm>

namespace daumier::runtime {
namespace {

constexpr int64_t kMostWindow = 1 << 16;  // Of pads, strides and dilations.

const OperatorTable& AllOperators() {
  static const OperatorTable table = [] {
    OperatorTable all = LayerOperators();
    for (OperatorTable part : {ImageOperators(), NormOperators(), PointwiseOperators(), RearrangingOperators(),
                               ReductionOperators(), ResizingOperators(), ShapeOperators()})
      all.merge(part);
    return all;
  }();
  return table;
}

}  // namespace

PlanOperator OperatorOf(const GraphNode& node) {
  const auto found = AllOperators().find(node.op);
  DAUMIER_CHECK(
      found != AllOperators().end(), "the operator is not run here {}",
      IsFoldedOperator(node.op) ? "on what depends on the inputs' numbers" : "(docs/runtime.md lists those that are)");
  return found->second;
}

bool IsRunHere(const std::string& op) {
  return AllOperators().contains(op) || IsFoldedOperator(op);
}

void SetPads(Window& window, size_t axis, int64_t both, bool upper) {
  window.before[axis] = upper ? both / 2 : both - both / 2;
  window.after[axis] = both - window.before[axis];
}

Window WindowOf(const GraphNode& node, const std::vector<int64_t>& kernel, const Shape& image) {
  const size_t axes = kernel.size();
  const std::vector<int64_t> ones(axes, 1), zeros(2 * axes, 0);
  const std::vector<int64_t> pads = node.Integers("pads", zeros);
  Window window{kernel, node.Integers("strides", ones), node.Integers("dilations", ones), {}, {}};
  const std::string auto_pad = node.Text("auto_pad", "NOTSET");
  const bool upper = auto_pad == "SAME_UPPER";
  DAUMIER_CHECK(upper || auto_pad == "NOTSET" || auto_pad == "SAME_LOWER" || auto_pad == "VALID",
                "there is no auto_pad '{}'", auto_pad);
  DAUMIER_CHECK(window.strides.size() == axes && window.dilations.size() == axes && pads.size() == 2 * axes,
                "strides, dilations or pads are not of {} axes", axes);
  DAUMIER_CHECK(node.Integers("kernel_shape", kernel) == kernel, "kernel_shape is not that of the weights, {}",
                ShapeText(kernel));
  window.before.assign(pads.begin(), pads.begin() + std::ptrdiff_t(axes));
  window.after.assign(pads.begin() + std::ptrdiff_t(axes), pads.end());
  for (size_t i = 0; i < axes; ++i) {
    const auto is_small = [](int64_t size, int64_t least) { return size >= least && size <= kMostWindow; };
    DAUMIER_CHECK(is_small(kernel[i], 1) && is_small(window.strides[i], 1) && is_small(window.dilations[i], 1) &&
                      is_small(window.before[i], 0) && is_small(window.after[i], 0),
                  "kernel, strides, dilations or pads are out of range");
    if (auto_pad == "VALID") SetPads(window, i, 0, upper);
    if (!upper && auto_pad != "SAME_LOWER") continue;
    const int64_t span = window.dilations[i] * (kernel[i] - 1) + 1, steps = (image[2 + i] - 1) / window.strides[i];
    SetPads(window, i, std::max(steps * window.strides[i] + span - image[2 + i], int64_t{0}), upper);
  }
  return window;
}

Shape WindowOutput(const Shape& image, int64_t channels, const Window& window) {
  Shape shape = {image[0], channels};
  for (size_t i = 0; i < window.kernel.size(); ++i) {
    const int64_t span = window.dilations[i] * (window.kernel[i] - 1) + 1;
    const int64_t rest = image[2 + i] + window.before[i] + window.after[i] - span;
    DAUMIER_CHECK(rest >= 0, "its window of {} is larger than the padded image of {}", span, rest + span);
    shape.push_back(rest / window.strides[i] + 1);
  }
  CheckedSize(shape, "its output");
  return shape;
}

}  // namespace daumier::runtime
