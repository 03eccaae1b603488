// Convolutions, normalisation, products of matrices, dropout.
#include "core/error.h"
#include "export/lowering.h"

#include <torch/types.h>

namespace daumier::exporting {
namespace {

/// The optional kernel_shape is written, for OpenCV 4.6 refuses a convolution without it.
std::string LowerConvolution(const Arguments& in, LoweringContext& context) {
  const auto kernel = in.Shape(1);
  auto pads = in.Spatial("padding");
  const auto one_side = pads;
  pads.insert(pads.end(), one_side.begin(), one_side.end());
  std::vector<OnnxAttribute> attributes = {{"kernel_shape", std::vector<int64_t>(kernel.begin() + 2, kernel.end())},
                                           {"strides", in.Spatial("stride")},
                                           {"pads", pads},
                                           {"dilations", in.Spatial("dilation")},
                                           {"group", in.Integer("groups")}};
  const bool transposed = in.Flag("transposed");
  if (transposed) attributes.push_back({"output_padding", in.Spatial("output_padding")});
  return context.graph().AddNode(transposed ? "ConvTranspose" : "Conv", context.Names(in, 0, 3), attributes);
}

/// A convolution whose padding is "same" or "valid"; an odd pixel is added at the end.
std::string LowerConvolutionMode(const Arguments& in, LoweringContext& context) {
  const auto weight = in.Shape(1);
  const std::vector<int64_t> kernel(weight.begin() + 2, weight.end());
  const auto dilation = in.Spatial("dilation");
  std::vector<int64_t> pads(2 * kernel.size(), 0);
  if (in.Text("padding") == "same") {
    for (size_t i = 0; i < kernel.size(); ++i) {
      const int64_t total = dilation[i] * (kernel[i] - 1);
      pads[i] = total / 2;
      pads[i + kernel.size()] = total - total / 2;
    }
  }
  return context.graph().AddNode("Conv", context.Names(in, 0, 3),
                                 {{"kernel_shape", kernel},
                                  {"strides", in.Spatial("stride")},
                                  {"pads", pads},
                                  {"dilations", dilation},
                                  {"group", in.Integer("groups")}});
}

std::string LowerBatchNorm(const Arguments& in, LoweringContext& context) {
  DAUMIER_CHECK(!in.Flag("training"), "batch norm is in training mode; call eval() first");
  DAUMIER_CHECK(!in.IsAbsent(3) && !in.IsAbsent(4), "batch norm has no running statistics");
  const int64_t num_channels = in.Shape(0)[1];
  const auto or_constant = [&](size_t i, float value) {
    return in.IsAbsent(i) ? context.graph().AddConstant(torch::full({num_channels}, value)) : context.Name(in.value(i));
  };
  const std::string scale = or_constant(1, 1), shift = or_constant(2, 0);
  return context.graph().AddNode(
      "BatchNormalization",
      {context.Name(in.value(0)), scale, shift, context.Name(in.value(3)), context.Name(in.value(4))},
      {{"epsilon", static_cast<float>(in.Real("eps"))}});
}

std::string Scaled(const torch::jit::Value* value, double factor, LoweringContext& context) {
  if (factor == 1) return context.Name(value);
  if (const auto weight = context.Weight(value); weight.has_value())
    return context.graph().AddConstant(*weight * factor);
  return context.graph().AddNode(
      "Mul", {context.Name(value), context.graph().AddConstant(torch::tensor(static_cast<float>(factor)))});
}

/// beta * bias + alpha * a b. A Linear layer passes t(weight), which Gemm reads as stored. OpenCV 4.6 ignores Gemm's own
/// factors and refuses a bias of one whose second matrix is not transposed.
std::string LowerAddmm(const Arguments& in, LoweringContext& context) {
  OnnxGraph& graph = context.graph();
  const double alpha = in.Real("alpha"), beta = in.Real("beta");
  const std::string stored = context.NameBeforeTranspose(in.value(2));
  if (alpha == 1 && beta == 1 && !stored.empty() && context.Weight(in.value(0)).has_value())
    return graph.AddNode("Gemm", {context.Name(in.value(1)), stored, context.Name(in.value(0))},
                         {{"transB", int64_t{1}}});
  const std::string product = graph.AddNode("MatMul", {Scaled(in.value(1), alpha, context), context.Name(in.value(2))});
  return graph.AddNode("Add", {product, Scaled(in.value(0), beta, context)});
}

std::string LowerLinear(const Arguments& in, LoweringContext& context) {
  OnnxGraph& graph = context.graph();
  if (in.Shape(0).size() == 2 && context.Weight(in.value(1)).has_value())
    return graph.AddNode("Gemm", context.Names(in, 0, 3), {{"transB", int64_t{1}}});
  const std::string x = context.Name(in.value(0));
  const std::string transposed =
      graph.AddNode("Transpose", {context.Name(in.value(1))}, {{"perm", std::vector<int64_t>{1, 0}}});
  const std::string product = graph.AddNode("MatMul", {x, transposed});
  return in.IsAbsent(2) ? product : graph.AddNode("Add", {product, context.Name(in.value(2))});
}

std::string LowerMatrixProduct(const Arguments& in, LoweringContext& context) {
  const auto vector = context.Weight(in.value(1));
  if (vector.has_value() && vector->dim() == 1 && in.Shape(0).size() > 1) {
    const std::string column = context.graph().AddConstant(vector->unsqueeze(1));
    return context.Reshaped(context.graph().AddNode("MatMul", {context.Name(in.value(0)), column}), in.OutputShape());
  }
  return context.graph().AddNode("MatMul", context.Names(in, 0, 2));
}

std::string LowerDropout(const Arguments& in, LoweringContext& context) {
  DAUMIER_CHECK(!in.Flag("train"), "dropout is in training mode; call eval() first");
  return context.Name(in.value(0));
}

}  // namespace

Lowerings LayerLowerings() {
  return {
      {"aten::_convolution", LowerConvolution},
      {"aten::_convolution_mode", LowerConvolutionMode},
      {"aten::addmm", LowerAddmm},
      {"aten::batch_norm", LowerBatchNorm},
      {"aten::bmm", LowerMatrixProduct},
      {"aten::dropout", LowerDropout},
      {"aten::feature_dropout", LowerDropout},
      {"aten::linear", LowerLinear},
      {"aten::matmul", LowerMatrixProduct},
      {"aten::mm", LowerMatrixProduct},
  };
}

}  // namespace daumier::exporting
