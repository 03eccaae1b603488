#include "export/lowering.h"

#include "core/error.h"
#include "tensor/shape.h"

#include <torch/csrc/jit/ir/constants.h>
#include <torch/csrc/jit/ir/ir.h>

#include <numeric>
#include <sstream>
#include <utility>

namespace daumier::exporting {
namespace {

using torch::jit::Node;
using torch::jit::Value;

/// @throws Error if the value is not constant in the trace.
c10::IValue Constant(const Value* value) {
  const auto constant = torch::jit::toIValue(value);
  DAUMIER_CHECK(constant.has_value(), "an argument depends on the input, ONNX needs a constant there");
  return *constant;
}

int64_t Integer(const Value* value) {
  return Constant(value).toInt();
}

std::vector<int64_t> Integers(const Value* value) {
  const auto constant = torch::jit::toIValue(value);
  if (constant.has_value()) return constant->toIntVector();
  DAUMIER_CHECK(value->node()->kind() == c10::prim::ListConstruct, "an argument is no list of integers");
  std::vector<int64_t> integers;
  for (const Value* item : value->node()->inputs()) integers.push_back(Integer(item));
  return integers;
}

bool IsAbsent(const Value* value) {
  const auto constant = torch::jit::toIValue(value);
  return constant.has_value() && constant->isNone();
}

int64_t Rank(const Value* value) {
  const auto sizes = value->type()->expect<c10::TensorType>()->sizes().concrete_sizes();
  DAUMIER_CHECK(sizes.has_value(), "the trace has no shape of %{}", value->debugName());
  return static_cast<int64_t>(sizes->size());
}

/// LibTorch takes one number for all spatial dimensions, ONNX Runtime requires one each.
std::vector<int64_t> Spatial(const Value* argument, const Value* image) {
  auto numbers = Integers(argument);
  if (numbers.size() == 1) numbers.assign(Rank(image) - 2, numbers[0]);
  return numbers;
}

// One function an operator; the arguments are those of LibTorch's own schema.

// _convolution(input, weight, bias?, stride, padding, dilation, transposed, output_padding, groups, ...)
std::string LowerConvolution(const Node& node, LoweringContext& context) {
  DAUMIER_CHECK(!Constant(node.input(6)).toBool(), "transposed convolutions have no lowering");
  const Value* image = node.input(0);
  auto pads = Spatial(node.input(4), image);
  const auto one_side = pads;
  pads.insert(pads.end(), one_side.begin(), one_side.end());
  return context.graph().AddNode("Conv", context.Names(node, 0, 3),
                                 {{"strides", Spatial(node.input(3), image)},
                                  {"pads", pads},
                                  {"dilations", Spatial(node.input(5), image)},
                                  {"group", Integer(node.input(8))}});
}

// batch_norm(input, weight?, bias?, running_mean?, running_var?, training, momentum, eps, ...)
std::string LowerBatchNorm(const Node& node, LoweringContext& context) {
  DAUMIER_CHECK(!Constant(node.input(5)).toBool(), "batch norm is in training mode; call eval() first");
  return context.graph().AddNode("BatchNormalization", context.Names(node, 0, 5),
                                 {{"epsilon", static_cast<float>(Constant(node.input(7)).toDouble())}});
}

// max_pool2d(input, kernel_size, stride, padding, dilation, ceil_mode)
std::string LowerMaxPool(const Node& node, LoweringContext& context) {
  DAUMIER_CHECK(!Constant(node.input(5)).toBool(), "max_pool2d with ceil_mode has no lowering");
  const Value* image = node.input(0);
  auto pads = Spatial(node.input(3), image);
  const auto one_side = pads;
  pads.insert(pads.end(), one_side.begin(), one_side.end());
  return context.graph().AddNode("MaxPool", {context.Name(image)},
                                 {{"kernel_shape", Spatial(node.input(1), image)},
                                  {"strides", Spatial(node.input(2), image)},
                                  {"pads", pads},
                                  {"dilations", Spatial(node.input(4), image)}});
}

// amax(input, dim, keepdim)
std::string LowerAmax(const Node& node, LoweringContext& context) {
  return context.graph().AddNode(
      "ReduceMax", {context.Name(node.input(0))},
      {{"axes", Integers(node.input(1))}, {"keepdims", int64_t{Constant(node.input(2)).toBool()}}});
}

// cat(tensors, dim)
std::string LowerConcatenation(const Node& node, LoweringContext& context) {
  std::vector<std::string> parts;
  for (const Value* part : node.input(0)->node()->inputs()) parts.push_back(context.Name(part));
  return context.graph().AddNode("Concat", parts, {{"axis", Integer(node.input(1))}});
}

// leaky_relu(input, slope)
std::string LowerLeakyRelu(const Node& node, LoweringContext& context) {
  return context.graph().AddNode("LeakyRelu", {context.Name(node.input(0))},
                                 {{"alpha", Constant(node.input(1)).toScalar().toFloat()}});
}

std::string LowerSine(const Node& node, LoweringContext& context) {
  return context.graph().AddNode("Sin", {context.Name(node.input(0))});
}

std::string LowerRelu(const Node& node, LoweringContext& context) {
  return context.graph().AddNode("Relu", {context.Name(node.input(0))});
}

// flatten(input, start_dim, end_dim)
std::string LowerFlatten(const Node& node, LoweringContext& context) {
  DAUMIER_CHECK(Integer(node.input(1)) == 1 && Integer(node.input(2)) == -1, "only flatten(1, -1) has a lowering");
  return context.graph().AddNode("Flatten", {context.Name(node.input(0))}, {{"axis", int64_t{1}}});
}

std::string LowerTranspose(const Node& node, LoweringContext& context) {
  return context.graph().AddNode("Transpose", {context.Name(node.input(0))}, {{"perm", std::vector<int64_t>{1, 0}}});
}

// transpose(input, dim0, dim1)
std::string LowerSwap(const Node& node, LoweringContext& context) {
  const int64_t rank = Rank(node.input(0));
  std::vector<int64_t> order(static_cast<size_t>(rank));
  std::iota(order.begin(), order.end(), 0);
  const auto axis = [&](size_t argument) {
    const int64_t dimension = Integer(node.input(argument));
    return static_cast<size_t>(dimension < 0 ? dimension + rank : dimension);
  };
  std::swap(order[axis(1)], order[axis(2)]);
  return context.graph().AddNode("Transpose", {context.Name(node.input(0))}, {{"perm", order}});
}

// narrow(input, dim, start, length)
std::string LowerNarrow(const Node& node, LoweringContext& context) {
  const int64_t begin = Integer(node.input(2)), length = Integer(node.input(3));
  OnnxGraph& graph = context.graph();
  return graph.AddNode("Slice", {context.Name(node.input(0)), graph.AddIntegers({begin}),
                                 graph.AddIntegers({begin + length}), graph.AddIntegers({Integer(node.input(1))})});
}

// slice(input, dim, start, end, step)
std::string LowerSlice(const Node& node, LoweringContext& context) {
  DAUMIER_CHECK(Integer(node.input(4)) == 1, "slice with a step has no lowering");
  OnnxGraph& graph = context.graph();
  return graph.AddNode("Slice",
                       {context.Name(node.input(0)), graph.AddIntegers({Integer(node.input(2))}),
                        graph.AddIntegers({Integer(node.input(3))}), graph.AddIntegers({Integer(node.input(1))})});
}

// squeeze(input, dim)
std::string LowerSqueeze(const Node& node, LoweringContext& context) {
  return context.graph().AddNode("Squeeze",
                                 {context.Name(node.input(0)), context.graph().AddIntegers({Integer(node.input(1))})});
}

// addmm(bias, a, b, beta, alpha); a Linear layer passes t(weight), which Gemm reads as stored.
std::string LowerAddmm(const Node& node, LoweringContext& context) {
  const std::string stored = context.NameBeforeTranspose(node.input(2));
  const std::string b = stored.empty() ? context.Name(node.input(2)) : stored;
  return context.graph().AddNode("Gemm", {context.Name(node.input(1)), b, context.Name(node.input(0))},
                                 {{"alpha", Constant(node.input(4)).toScalar().toFloat()},
                                  {"beta", Constant(node.input(3)).toScalar().toFloat()},
                                  {"transB", int64_t{!stored.empty()}}});
}

std::string LowerMatrixProduct(const Node& node, LoweringContext& context) {
  return context.graph().AddNode("MatMul", context.Names(node, 0, 2));
}

// add(a, b, alpha)
std::string LowerAdd(const Node& node, LoweringContext& context) {
  DAUMIER_CHECK(Constant(node.input(2)).toScalar().toDouble() == 1.0, "add with a factor has no lowering");
  return context.graph().AddNode("Add", context.Names(node, 0, 2));
}

std::string LowerMul(const Node& node, LoweringContext& context) {
  return context.graph().AddNode("Mul", context.Names(node, 0, 2));
}

// sub(a, b, alpha)
std::string LowerSub(const Node& node, LoweringContext& context) {
  DAUMIER_CHECK(Constant(node.input(2)).toScalar().toDouble() == 1.0, "sub with a factor has no lowering");
  return context.graph().AddNode("Sub", context.Names(node, 0, 2));
}

std::string LowerDiv(const Node& node, LoweringContext& context) {
  return context.graph().AddNode("Div", context.Names(node, 0, 2));
}

// unsqueeze(input, dim): the axis counts in the result.
std::string LowerUnsqueeze(const Node& node, LoweringContext& context) {
  const int64_t axis = Integer(node.input(1));
  const int64_t rank = Rank(node.input(0)) + 1;
  return context.graph().AddNode(
      "Unsqueeze", {context.Name(node.input(0)), context.graph().AddIntegers({axis < 0 ? axis + rank : axis})});
}

// reshape(input, shape)
std::string LowerReshape(const Node& node, LoweringContext& context) {
  return context.graph().AddNode("Reshape",
                                 {context.Name(node.input(0)), context.graph().AddIntegers(Integers(node.input(1)))});
}

}  // namespace

void LoweringContext::SetWeight(const Value* value, const std::string& name, const torch::Tensor& weight) {
  weights_[value] = {name, weight};
}

std::string LoweringContext::Name(const Value* value) {
  if (const auto named = names_.find(value); named != names_.end()) return named->second;
  if (const auto weight = weights_.find(value); weight != weights_.end()) {
    return graph_.AddInitializer(weight->second.name, weight->second.tensor);
  }
  // A factor like 30 in x * 30.
  if (const auto constant = torch::jit::toIValue(value); constant.has_value() && constant->isScalar()) {
    return names_[value] = graph_.AddInitializer("constant_" + value->debugName(),
                                                 torch::tensor(constant->toScalar().toFloat(), torch::kFloat32));
  }
  if (value->node()->kind() == c10::aten::t) return names_[value] = LowerTranspose(*value->node(), *this);
  throw Error(fmt::format("%{}, made by {}, is neither a tensor of the graph nor a weight", value->debugName(),
                          value->node()->kind().toQualString()));
}

std::vector<std::string> LoweringContext::Names(const Node& node, size_t first, size_t last) {
  std::vector<std::string> names;
  for (size_t i = first; i < last; ++i) {
    if (!IsAbsent(node.input(i))) names.push_back(Name(node.input(i)));
  }
  return names;
}

std::string LoweringContext::NameBeforeTranspose(const Value* value) {
  const bool of_weight = value->node()->kind() == c10::aten::t && weights_.count(value->node()->input(0)) == 1;
  return of_weight ? Name(value->node()->input(0)) : "";
}

const std::map<std::string, LoweringFunction>& LoweringTable() {
  static const std::map<std::string, LoweringFunction> table = {
      {"aten::_convolution", LowerConvolution},
      {"aten::add", LowerAdd},
      {"aten::addmm", LowerAddmm},
      {"aten::amax", LowerAmax},
      {"aten::batch_norm", LowerBatchNorm},
      {"aten::cat", LowerConcatenation},
      {"aten::div", LowerDiv},
      {"aten::flatten", LowerFlatten},
      {"aten::leaky_relu", LowerLeakyRelu},
      {"aten::matmul", LowerMatrixProduct},
      {"aten::max_pool2d", LowerMaxPool},
      {"aten::mm", LowerMatrixProduct},
      {"aten::mul", LowerMul},
      {"aten::narrow", LowerNarrow},
      {"aten::relu", LowerRelu},
      {"aten::reshape", LowerReshape},
      {"aten::sin", LowerSine},
      {"aten::slice", LowerSlice},
      {"aten::squeeze", LowerSqueeze},
      {"aten::sub", LowerSub},
      {"aten::t", LowerTranspose},
      {"aten::transpose", LowerSwap},
      {"aten::unsqueeze", LowerUnsqueeze},
  };
  return table;
}

void LowerNode(const Node& node, LoweringContext& context) {
  const auto kind = node.kind();
  if (kind == c10::prim::Constant || kind == c10::prim::ListConstruct) return;
  if (kind == c10::aten::t) return;  // Lowered where it is used, for Gemm takes a weight without it.
  std::ostringstream line;
  line << node;
  const auto entry = LoweringTable().find(kind.toQualString());
  DAUMIER_CHECK(
      entry != LoweringTable().end(),
      "operator {} cannot be exported to ONNX: it has no entry in LoweringTable() of export/lowering.cpp. It occurs in "
      "this line of the trace:\n{}",
      kind.toQualString(), line.str());
  try {
    context.SetName(node.output(), entry->second(node, context));
  } catch (const Error& error) {
    throw Error(fmt::format("operator {} cannot be exported to ONNX: {}. It occurs in this line of the trace:\n{}",
                            kind.toQualString(), error.what(), line.str()));
  }
}

}  // namespace daumier::exporting
