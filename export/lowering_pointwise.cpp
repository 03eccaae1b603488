// Activations and arithmetic.
#include "core/error.h"
#include "export/lowering.h"

#include <torch/csrc/jit/ir/ir.h>
#include <torch/types.h>

#include <algorithm>
#include <cmath>

namespace daumier::exporting {
namespace {

using torch::jit::Value;

std::string AddScalar(double value, LoweringContext& context) {
  return context.graph().AddConstant(torch::tensor(static_cast<float>(value)));
}

LoweringFunction Unary(const std::string& op) {
  return [op](const Arguments& in, LoweringContext& context) {
    return context.graph().AddNode(op, {context.Name(in.value(0))});
  };
}

std::string LowerLeakyRelu(const Arguments& in, LoweringContext& context) {
  return context.graph().AddNode("LeakyRelu", {context.Name(in.value(0))},
                                 {{"alpha", static_cast<float>(in.Real("negative_slope"))}});
}

std::string LowerElu(const Arguments& in, LoweringContext& context) {
  DAUMIER_CHECK(in.Real("scale") == 1 && in.Real("input_scale") == 1, "elu with scales (selu) has no lowering");
  return context.graph().AddNode("Elu", {context.Name(in.value(0))}, {{"alpha", static_cast<float>(in.Real("alpha"))}});
}

/// The slopes count along axis 1, as in LibTorch; ONNX aligns shapes at the last axis.
std::string LowerPrelu(const Arguments& in, LoweringContext& context) {
  const auto slopes = context.Weight(in.value(1));
  DAUMIER_CHECK(slopes.has_value(), "the slopes of prelu are computed from the input");
  std::vector<int64_t> shape(std::max<size_t>(in.Shape(0).size() - 1, 1), 1);
  shape[0] = slopes->numel();
  return context.graph().AddNode("PRelu",
                                 {context.Name(in.value(0)), context.graph().AddConstant(slopes->reshape(shape))});
}

/// Small bounds by Relu, a + relu(x - a) and b - relu(b - x), which is exact to the rounding of a and b: OpenCV 4.6 has
/// no Clip whose bounds are inputs, and no maximum of a tensor and a number.
std::string Bounded(const std::string& name, std::optional<double> lowest, std::optional<double> highest,
                    LoweringContext& context) {
  constexpr double kSmall = 16;
  OnnxGraph& graph = context.graph();
  if (std::abs(lowest.value_or(0)) > kSmall || std::abs(highest.value_or(0)) > kSmall) {
    std::vector<std::string> inputs = {name, lowest.has_value() ? AddScalar(*lowest, context) : ""};
    if (highest.has_value()) inputs.push_back(AddScalar(*highest, context));
    return graph.AddNode("Clip", inputs);
  }
  std::string bounded = name;
  if (lowest == 0) {
    bounded = graph.AddNode("Relu", {bounded});
  } else if (lowest.has_value()) {
    const std::string a = AddScalar(*lowest, context);
    bounded = graph.AddNode("Add", {graph.AddNode("Relu", {graph.AddNode("Sub", {bounded, a})}), a});
  }
  if (highest.has_value()) {
    const std::string b = AddScalar(*highest, context);
    bounded = graph.AddNode("Sub", {b, graph.AddNode("Relu", {graph.AddNode("Sub", {b, bounded})})});
  }
  return bounded;
}

/// Of arguments of these names, which may be None.
LoweringFunction Clamp(const std::string& lowest, const std::string& highest) {
  return [lowest, highest](const Arguments& in, LoweringContext& context) {
    const auto bound = [&](const std::string& name) {
      return in.IsAbsent(name) ? std::nullopt : std::optional<double>(in.Real(name));
    };
    return Bounded(context.Name(in.value(0)), bound(lowest), bound(highest), context);
  };
}

std::string LowerRelu6(const Arguments& in, LoweringContext& context) {
  return Bounded(context.Name(in.value(0)), 0, 6, context);
}

std::string LowerSilu(const Arguments& in, LoweringContext& context) {
  const std::string x = context.Name(in.value(0));
  return context.graph().AddNode("Mul", {x, context.graph().AddNode("Sigmoid", {x})});
}

std::string LowerPower(const Arguments& in, LoweringContext& context) {
  const std::string x = context.Name(in.value(0));
  const double exponent = in.Real("exponent");
  if (exponent == 2) return context.graph().AddNode("Mul", {x, x});
  if (exponent == 0.5) return context.graph().AddNode("Sqrt", {x});
  return context.graph().AddNode("Pow", {x, AddScalar(exponent, context)});
}

std::string LowerSquare(const Arguments& in, LoweringContext& context) {
  const std::string x = context.Name(in.value(0));
  return context.graph().AddNode("Mul", {x, x});
}

bool IsTensor(const Value* value) {
  return value->type()->kind() == c10::TypeKind::TensorType;
}

/// A weight that meets a tensor of `shape`, in the form that OpenCV 4.6 repeats rightly: a number for each channel, or
/// one for each number of a sample. Other values under their own names.
std::string Operand(const Value* value, const std::vector<int64_t>& shape, LoweringContext& context) {
  const auto weight = context.Weight(value);
  if (!weight.has_value() || weight->dim() == 0 || shape.size() < 3) return context.Name(value);
  torch::Tensor shortened = *weight;
  while (shortened.dim() > 0 && shortened.size(0) == 1) shortened = shortened.squeeze(0);
  const std::vector<int64_t> of_sample(shape.begin() + 1, shape.end());
  const bool for_channels = shortened.dim() == int64_t(of_sample.size()) && shortened.numel() == of_sample[0] &&
                            shortened.size(0) == of_sample[0];
  if (shortened.dim() > 0 && shortened.dim() <= int64_t(of_sample.size()) && !for_channels)
    shortened = shortened.expand(of_sample);
  return shortened.sizes() == weight->sizes() ? context.Name(value) : context.graph().AddConstant(shortened);
}

/// Both, in order.
std::pair<std::string, std::string> Operands(const Arguments& in, LoweringContext& context) {
  const std::vector<int64_t> shape = in.OutputShape();
  return {Operand(in.value(0), shape, context), Operand(in.value(1), shape, context)};
}

bool IsWeightBeforeTensor(const Arguments& in, const LoweringContext& context) {
  const auto first = context.Weight(in.value(0));
  return first.has_value() && first->numel() > 1 && IsTensor(in.value(1));
}

/// a + alpha b, a - alpha b. OpenCV 4.6 exchanges the sides of a difference whose first one is a weight.
LoweringFunction Sum(const std::string& op) {
  return [op](const Arguments& in, LoweringContext& context) {
    OnnxGraph& graph = context.graph();
    auto [a, b] = Operands(in, context);
    const double factor = in.Real("alpha");
    const bool negated = op == "Sub" && IsWeightBeforeTensor(in, context);
    if (factor != 1) b = graph.AddNode("Mul", {b, AddScalar(factor, context)});
    if (negated) return graph.AddNode("Add", {graph.AddNode("Neg", {b}), a});
    return graph.AddNode(op, {a, b});
  };
}

/// Products of columns with rows, [..., M, 1] and [..., 1, N], which are products of matrices too.
bool IsOuterProduct(const Arguments& in, const LoweringContext& context) {
  if (!IsTensor(in.value(1))) return false;
  if (context.Weight(in.value(0)).has_value() || context.Weight(in.value(1)).has_value()) return false;
  const auto a = in.Shape(0), b = in.Shape(1);
  const size_t rank = a.size();
  if (rank != b.size() || rank < 3 || a[rank - 1] != 1 || b[rank - 2] != 1) return false;
  return std::equal(a.begin(), a.end() - 2, b.begin());
}

/// OpenCV 4.6 has no product of tensors each of which is repeated along an axis of the other.
std::string LowerMul(const Arguments& in, LoweringContext& context) {
  if (IsOuterProduct(in, context)) return context.graph().AddNode("MatMul", context.Names(in, 0, 2));
  const auto [a, b] = Operands(in, context);
  return context.graph().AddNode("Mul", {a, b});
}

std::string LowerDiv(const Arguments& in, LoweringContext& context) {
  DAUMIER_CHECK(in.IsAbsent("rounding_mode"), "a division that rounds has no lowering");
  OnnxGraph& graph = context.graph();
  const auto [a, b] = Operands(in, context);
  if (!IsWeightBeforeTensor(in, context)) return graph.AddNode("Div", {a, b});
  // OpenCV 4.6 exchanges the sides of a quotient whose first one is a weight.
  return graph.AddNode("Mul", {graph.AddNode("Div", {AddScalar(1, context), b}), a});
}

LoweringFunction Binary(const std::string& op) {
  return [op](const Arguments& in, LoweringContext& context) {
    DAUMIER_CHECK(in.size() == 2, "this form has no lowering");
    return context.graph().AddNode(op, context.Names(in, 0, 2));
  };
}

/// The 1 of 1 - x.
std::string LowerFullLike(const Arguments& in, LoweringContext& context) {
  DAUMIER_CHECK(IsReadByArithmeticAlone(in.node().output()), "its constant is read by more than arithmetic");
  return AddScalar(in.Real("fill_value"), context);
}

}  // namespace

Lowerings PointwiseLowerings() {
  return {
      {"aten::abs", Unary("Abs")},
      {"aten::add", Sum("Add")},
      {"aten::clamp", Clamp("min", "max")},
      {"aten::clamp_max", Clamp("", "max")},
      {"aten::clamp_min", Clamp("min", "")},
      {"aten::div", LowerDiv},
      {"aten::elu", LowerElu},
      {"aten::exp", Unary("Exp")},
      {"aten::full_like", LowerFullLike},
      {"aten::hardtanh", Clamp("min_val", "max_val")},
      {"aten::leaky_relu", LowerLeakyRelu},
      {"aten::max", Binary("Max")},
      {"aten::maximum", Binary("Max")},
      {"aten::min", Binary("Min")},
      {"aten::minimum", Binary("Min")},
      {"aten::mul", LowerMul},
      {"aten::neg", Unary("Neg")},
      {"aten::pow", LowerPower},
      {"aten::prelu", LowerPrelu},
      {"aten::relu", Unary("Relu")},
      {"aten::relu6", LowerRelu6},
      {"aten::sigmoid", Unary("Sigmoid")},
      {"aten::silu", LowerSilu},
      {"aten::sin", Unary("Sin")},
      {"aten::sqrt", Unary("Sqrt")},
      {"aten::square", LowerSquare},
      {"aten::sub", Sum("Sub")},
      {"aten::tanh", Unary("Tanh")},
  };
}

}  // namespace daumier::exporting
