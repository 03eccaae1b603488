// Sums, means, maxima, softmax.
#include "core/error.h"
#include "export/lowering.h"

#include <torch/types.h>

namespace daumier::exporting {
namespace {

bool KeepsAxes(const Arguments& in) {
  return in.Has("keepdim") && in.Flag("keepdim");
}

/// OpenCV 4.6 inserts an axis after the batch where this holds more than one sample: the reshape removes it.
std::string Reduced(const std::string& op, const Arguments& in, LoweringContext& context) {
  DAUMIER_CHECK(!in.IsAbsent("dim") && !in.Integers("dim").empty(), "it reduces all axes, the batch among them");
  const auto axes = in.Axes("dim", int64_t(in.Shape(0).size()));
  const std::string reduced =
      context.graph().AddNode(op, {context.Name(in.value(0))}, {{"axes", axes}, {"keepdims", int64_t{KeepsAxes(in)}}});
  return axes[0] == 0 ? reduced : context.Reshaped(reduced, in.OutputShape());
}

LoweringFunction Extreme(const std::string& op) {
  return [op](const Arguments& in, LoweringContext& context) { return Reduced(op, in, context); };
}

std::string LowerMean(const Arguments& in, LoweringContext& context) {
  const auto rank = int64_t(in.Shape(0).size());
  if (rank != 4 || in.IsAbsent("dim") || in.Axes("dim", rank) != std::vector<int64_t>{2, 3})
    return Reduced("ReduceMean", in, context);
  const std::string means = context.graph().AddNode("GlobalAveragePool", {context.Name(in.value(0))});
  return KeepsAxes(in) ? means : context.graph().AddNode("Flatten", {means}, {{"axis", int64_t{1}}});
}

/// The mean times the number of terms: ReduceSum of opset 13 reads its axes as an input, which OpenCV 4.6 refuses.
std::string LowerSum(const Arguments& in, LoweringContext& context) {
  const std::string mean = LowerMean(in, context);
  const auto shape = in.Shape(0);
  float num_terms = 1;
  for (const int64_t axis : in.Axes("dim", int64_t(shape.size()))) {
    DAUMIER_CHECK(axis > 0, "it sums over the batch, whose size is free");
    num_terms *= static_cast<float>(shape[size_t(axis)]);
  }
  return context.graph().AddNode("Mul", {mean, context.graph().AddConstant(torch::tensor(num_terms))});
}

LoweringFunction Softmax(const std::string& op) {
  return [op](const Arguments& in, LoweringContext& context) {
    return context.graph().AddNode(op, {context.Name(in.value(0))},
                                   {{"axis", in.Axis("dim", int64_t(in.Shape(0).size()))}});
  };
}

}  // namespace

Lowerings ReductionLowerings() {
  return {
      {"aten::amax", Extreme("ReduceMax")},         {"aten::amin", Extreme("ReduceMin")},
      {"aten::log_softmax", Softmax("LogSoftmax")}, {"aten::mean", LowerMean},
      {"aten::softmax", Softmax("Softmax")},        {"aten::sum", LowerSum},
  };
}

}  // namespace daumier::exporting
