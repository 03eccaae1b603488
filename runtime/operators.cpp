#include "runtime/operators.h"

#include "core/error.h"

#include <algorithm>

namespace daumier::runtime {
namespace {

constexpr int64_t kMostWindow = 1 << 16;  // Of pads, strides and dilations.

}  // namespace

PlanOperator OperatorOf(const GraphNode& node) {
  static const OperatorTable table = [] {
    OperatorTable all = LayerOperators();
    for (OperatorTable part : {ImageOperators(), PointwiseOperators(), ShapeOperators(), ReductionOperators()})
      all.merge(part);
    return all;
  }();
  const auto found = table.find(node.op);
  DAUMIER_CHECK(found != table.end(), "the operator is not run here (those of `daumier export` are)");
  return found->second;
}

size_t AxisOf(int64_t axis, size_t rank) {
  const int64_t counted = axis < 0 ? axis + int64_t(rank) : axis;
  DAUMIER_CHECK(counted >= 0 && counted < int64_t(rank), "there is no axis {} of {}", axis, rank);
  return size_t(counted);
}

Shape BroadcastShape(const Shape& a, const Shape& b) {
  Shape shape(std::max(a.size(), b.size()));
  for (size_t i = 0; i < shape.size(); ++i) {
    const int64_t of_a = i < a.size() ? a[a.size() - 1 - i] : 1, of_b = i < b.size() ? b[b.size() - 1 - i] : 1;
    DAUMIER_CHECK(of_a == of_b || of_a == 1 || of_b == 1, "the shapes {} and {} do not match", ShapeText(a),
                  ShapeText(b));
    shape[shape.size() - 1 - i] = std::max(of_a, of_b);
  }
  return shape;
}

Window WindowOf(const GraphNode& node, const std::vector<int64_t>& kernel) {
  const size_t axes = kernel.size();
  const std::vector<int64_t> ones(axes, 1), zeros(2 * axes, 0);
  const std::vector<int64_t> pads = node.Integers("pads", zeros);
  Window window{kernel, node.Integers("strides", ones), node.Integers("dilations", ones), {}, {}};
  DAUMIER_CHECK(node.Text("auto_pad", "NOTSET") == "NOTSET", "auto_pad is not read");
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
