// Pooling and resizing of images, (N, C, H, W).
#include "core/error.h"
#include "export/lowering.h"

#include <torch/csrc/jit/ir/ir.h>
#include <torch/types.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace daumier::exporting {
namespace {

void RequireImage(const Arguments& in) {
  DAUMIER_CHECK(in.Shape(0).size() == 4, "the input has {} dimensions, expected (N, C, H, W)", in.Shape(0).size());
}

/// Of a pooling whose stride is that of the kernel where it is not given.
std::vector<int64_t> PoolStrides(const Arguments& in) {
  const auto strides = in.Spatial("stride");
  return strides.empty() ? in.Spatial("kernel_size") : strides;
}

/// ONNX and LibTorch disagree about windows beyond the padding: ceil_mode is accepted where it changes nothing.
void RequireWholeWindows(const Arguments& in) {
  if (!in.Flag("ceil_mode")) return;
  const auto kernel = in.Spatial("kernel_size"), strides = PoolStrides(in), padding = in.Spatial("padding");
  const auto dilation = in.Has("dilation") ? in.Spatial("dilation") : std::vector<int64_t>(2, 1);
  for (size_t i = 0; i < 2; ++i) {
    const int64_t free = in.Shape(0)[2 + i] + 2 * padding[i] - dilation[i] * (kernel[i] - 1) - 1;
    DAUMIER_CHECK(free % strides[i] == 0, "ceil_mode adds a window, for which there is no lowering");
  }
}

std::string LowerMaxPool(const Arguments& in, LoweringContext& context) {
  RequireImage(in);
  RequireWholeWindows(in);
  auto pads = in.Spatial("padding");
  pads.insert(pads.end(), {pads[0], pads[1]});
  return context.graph().AddNode("MaxPool", {context.Name(in.value(0))},
                                 {{"kernel_shape", in.Spatial("kernel_size")},
                                  {"strides", PoolStrides(in)},
                                  {"pads", pads},
                                  {"dilations", in.Spatial("dilation")}});
}

/// Padding that counts in the mean becomes a node of its own: OpenCV 4.6 ignores count_include_pad.
std::string LowerAveragePool(const Arguments& in, LoweringContext& context) {
  RequireImage(in);
  RequireWholeWindows(in);
  DAUMIER_CHECK(in.IsAbsent("divisor_override"), "divisor_override has no lowering");
  OnnxGraph& graph = context.graph();
  std::string image = context.Name(in.value(0));
  auto pads = in.Spatial("padding");
  if (in.Flag("count_include_pad") && (pads[0] > 0 || pads[1] > 0)) {
    image = graph.AddNode("Pad", {image, graph.AddIntegers({0, 0, pads[0], pads[1], 0, 0, pads[0], pads[1]})},
                          {{"mode", std::string("constant")}});
    pads = {0, 0};
  }
  pads.insert(pads.end(), {pads[0], pads[1]});
  return graph.AddNode("AveragePool", {image},
                       {{"kernel_shape", in.Spatial("kernel_size")}, {"strides", PoolStrides(in)}, {"pads", pads}});
}

/// The output of an operator that treats rows, columns and channels alike, as R x S with constant matrices: R and S are
/// what LibTorch makes of single pixels. Covers sizes and scales for which ONNX has no operator of the same rounding.
std::string LowerToMatrices(const Arguments& in, LoweringContext& context) {
  const auto shape = in.Shape(0), output = in.OutputShape();
  const auto resized = [&](const torch::Tensor& images) {
    torch::jit::Stack stack = {images};
    for (size_t i = 1; i < in.size(); ++i) {
      const auto argument = ConstantValue(in.value(i));
      DAUMIER_CHECK(argument.has_value(), "an argument depends on the input");
      stack.push_back(*argument);
    }
    in.node().getOperation()(stack);
    return stack.at(0).toTensor();
  };
  const auto basis = [](int64_t size) { return torch::eye(size).view({size, 1, 1, size}); };
  const auto columns = basis(shape[3]).expand({shape[3], 1, shape[2], shape[3]}).contiguous();
  const auto rows = basis(shape[2]).transpose(2, 3).expand({shape[2], 1, shape[2], shape[3]}).contiguous();
  const auto of_columns = resized(columns).select(2, 0).squeeze(1), of_rows = resized(rows).select(3, 0).squeeze(1);
  DAUMIER_CHECK(of_columns.size(1) == output[3] && of_rows.size(1) == output[2], "it depends on the number of images");
  OnnxGraph& graph = context.graph();
  // Each product is with the last axis, the form that every runtime has.
  const auto times = [&](const std::string& image, const torch::Tensor& matrix) {
    return graph.AddNode("MatMul", {image, graph.AddConstant(matrix)});
  };
  const auto turned = [&](const std::string& image) {
    return graph.AddNode("Transpose", {image}, {{"perm", std::vector<int64_t>{0, 1, 3, 2}}});
  };
  return turned(times(turned(times(context.Name(in.value(0)), of_columns)), of_rows));
}

std::string LowerAdaptiveAveragePool(const Arguments& in, LoweringContext& context) {
  RequireImage(in);
  const auto shape = in.Shape(0), output = in.OutputShape();
  const std::string image = context.Name(in.value(0));
  if (output[2] == 1 && output[3] == 1) return context.graph().AddNode("GlobalAveragePool", {image});
  if (shape[2] % output[2] != 0 || shape[3] % output[3] != 0) return LowerToMatrices(in, context);
  const std::vector<int64_t> windows = {shape[2] / output[2], shape[3] / output[3]};
  return context.graph().AddNode("AveragePool", {image}, {{"kernel_shape", windows}, {"strides", windows}});
}

/// LibTorch steps by 1 / scale where a scale is given, even if that is not the ratio of the sizes: 7 pixels x 0.5.
bool ScaleIsRatioOfSizes(const Arguments& in) {
  const auto shape = in.Shape(0), output = in.OutputShape();
  std::vector<double> scales;
  if (!in.IsAbsent("scale_factors")) scales = in.Reals("scale_factors");
  if (!in.IsAbsent("scales_h")) scales = {in.Real("scales_h"), in.Real("scales_w")};
  for (size_t i = 0; i < scales.size(); ++i)
    if (scales[i] * double(shape[2 + i]) != double(output[2 + i])) return false;
  return true;
}

/// The batch is free, so that sizes cannot be given: scales, of which size x scale rounds down to the size wanted.
float ResizeScale(int64_t size, int64_t wanted) {
  float scale = static_cast<float>(wanted) / static_cast<float>(size);
  while (static_cast<int64_t>(std::floor(scale * static_cast<float>(size))) < wanted)
    scale = std::nextafter(scale, std::numeric_limits<float>::infinity());
  return scale;
}

std::string AddResize(const Arguments& in, LoweringContext& context, const std::vector<OnnxAttribute>& attributes) {
  const auto shape = in.Shape(0), output = in.OutputShape();
  const std::vector<float> scales = {1, 1, ResizeScale(shape[2], output[2]), ResizeScale(shape[3], output[3])};
  OnnxGraph& graph = context.graph();
  // No region of interest.
  return graph.AddNode("Resize", {context.Name(in.value(0)), "", graph.AddConstant(torch::tensor(scales))}, attributes);
}

std::string LowerNearest(const Arguments& in, LoweringContext& context) {
  const auto shape = in.Shape(0), output = in.OutputShape();
  if (output[2] % shape[2] != 0 || output[3] % shape[3] != 0 || !ScaleIsRatioOfSizes(in))
    return LowerToMatrices(in, context);
  return AddResize(in, context,
                   {{"mode", std::string("nearest")},
                    {"coordinate_transformation_mode", std::string("asymmetric")},
                    {"nearest_mode", std::string("floor")}});
}

std::string LowerBilinear(const Arguments& in, LoweringContext& context) {
  const bool align_corners = in.Flag("align_corners");
  if (!align_corners && !ScaleIsRatioOfSizes(in)) return LowerToMatrices(in, context);
  return AddResize(in, context,
                   {{"mode", std::string("linear")},
                    {"coordinate_transformation_mode", std::string(align_corners ? "align_corners" : "half_pixel")}});
}

}  // namespace

Lowerings ImageLowerings() {
  return {
      {"aten::adaptive_avg_pool2d", LowerAdaptiveAveragePool},
      {"aten::avg_pool2d", LowerAveragePool},
      {"aten::max_pool2d", LowerMaxPool},
      {"aten::upsample_bicubic2d", LowerToMatrices},
      {"aten::upsample_bilinear2d", LowerBilinear},
      {"aten::upsample_nearest2d", LowerNearest},
  };
}

}  // namespace daumier::exporting
