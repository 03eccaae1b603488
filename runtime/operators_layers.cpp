// Convolutions, batch norm, products of matrices.
#include "core/error.h"
#include "runtime/graph_fusion.h"
#include "runtime/operators.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace daumier::runtime {
namespace {

Epilogue ActivationOf(const GraphNode& node) {
  return {.activation = node.Text(kActivation, ""), .alpha = node.Real(kActivationAlpha, 0)};
}

/// Of a convolution or a transposed one: its images and what its weights are for.
struct ConvolutionSizes {
  Shape image;
  int64_t groups = 1;
  std::vector<int64_t> kernel;
};

ConvolutionSizes SizesOfConvolution(const GraphNode& node, const PlanBuilder& plan) {
  ConvolutionSizes sizes{plan.ShapeOf(node.inputs.at(0)), node.Integer("group", 1), {}};
  const Shape& weights = plan.Weight(node, 1).shape;
  DAUMIER_CHECK((sizes.image.size() == 3 || sizes.image.size() == 4) && weights.size() == sizes.image.size(),
                "the image is {} and the weights are {}, expected (N, C, W) or (N, C, H, W) and as many axes",
                ShapeText(sizes.image), ShapeText(weights));
  DAUMIER_CHECK(sizes.groups >= 1 && sizes.image[1] % sizes.groups == 0 && weights[0] % sizes.groups == 0,
                "{} groups do not divide the channels of {} and {}", sizes.groups, ShapeText(sizes.image),
                ShapeText(weights));
  sizes.kernel.assign(weights.begin() + 2, weights.end());
  return sizes;
}

/// The bias of `channels` numbers, or an empty layout.
Layout BiasLayout(const GraphNode& node, int64_t channels, const PlanBuilder& plan) {
  if (!node.Reads(2)) return {};
  const Shape& shape = plan.Weight(node, 2).shape;
  DAUMIER_CHECK(shape == Shape{channels}, "the bias is {}, expected ({})", ShapeText(shape), channels);
  return PlainLayout(shape);
}

void AddBias(const GraphNode& node, const Layout& layout, const PlanBuilder& plan,
             std::vector<PlanArgument>& arguments) {
  if (node.Reads(2)) arguments.push_back({DNNL_ARG_BIAS, layout, {.constant = plan.Weight(node, 2).numbers.data()}});
}

/// What is added is in place: where it lies if nothing else reads it, else a copy.
Place TargetWithAddend(const GraphNode& node, const Primitive& primitive, const Shape& shape, const Place& source,
                       PlanBuilder& plan) {
  const std::string& addend = node.inputs[kAddend];
  const PlannedValue& value = plan.Value(addend);
  if (value.layout == primitive.target && plan.MayOverwrite(addend) && value.place.buffer != source.buffer)
    return value.place;
  const Place from = plan.In(addend, primitive.target), target = plan.NewOutput(node, shape, primitive.target);
  plan.AddCopy(node, from, target, SizeOf(primitive.target));
  return target;
}

/// A sum of a convolution and a tensor that is repeated, or of a repeated convolution: by our own loops.
void AddRepeated(const GraphNode& node, const Place& convolved, const Shape& shape, const Layout& layout,
                 PlanBuilder& plan) {
  const GraphNode inner{.op = "Conv", .name = node.name + "/sum", .inputs = {}, .output = node.output + "/convolved"};
  plan.Define(inner, shape, layout, convolved);
  const std::string& addend = node.inputs[kAddend];
  const Shape sum = BroadcastShape(shape, plan.ShapeOf(addend));
  const Place target =
      AddPlainBinary(node, "Add", plan.Plain(inner.output), shape, plan.Plain(addend), plan.ShapeOf(addend), sum, plan);
  if (const Epilogue epilogue = ActivationOf(node); !epilogue.activation.empty())
    AddUnary(node, {epilogue.activation, epilogue.alpha}, target, target, CheckedSize(sum, "its output"), plan);
}

/// The layouts that oneDNN chooses, but not channels last, which it prefers with AVX-512: parts of a concatenation
/// would have to be copied, and narrow images are not safe in it. Blocks of 16 instead, or plain where it has no code
/// of its own for them: odd groups.
Primitive ConvolutionInBlocks(const Shape& image, const Shape& weights, const Layout& bias, const Shape& shape,
                              const Window& window, const Epilogue& epilogue) {
  const Layout any_weights = AnyLayout(weights);
  Primitive chosen = MakeConvolution(AnyLayout(image), any_weights, bias, AnyLayout(shape), window, epilogue);
  if (BlockOf(chosen.source, image) != 0 && BlockOf(chosen.target, shape) != 0) return chosen;
  constexpr int kBlock = 16;
  const Layout source = image[1] < kBlock ? AnyLayout(image) : BlockedLayout(image, kBlock);
  Primitive blocked = MakeConvolution(source, any_weights, bias, BlockedLayout(shape, kBlock), window, epilogue);
  if (blocked.kernel.starts_with("jit")) return blocked;
  return MakeConvolution(PlainLayout(image), any_weights, bias, PlainLayout(shape), window, epilogue);
}

void PlanConvolution(const GraphNode& node, PlanBuilder& plan) {
  const auto [image, groups, kernel] = SizesOfConvolution(node, plan);
  const Shape& weights = plan.Weight(node, 1).shape;
  DAUMIER_CHECK(image[1] == groups * weights[1], "the image has {} channels, the weights are {} for {} groups",
                image[1], ShapeText(weights), groups);
  const Window window = WindowOf(node, kernel, image);
  const Shape shape = WindowOutput(image, weights[0], window);
  Shape grouped = weights;
  if (groups > 1) {
    grouped[0] /= groups;
    grouped.insert(grouped.begin(), groups);
  }
  const bool has_addend = node.Reads(kAddend);
  const bool is_sum = has_addend && plan.ShapeOf(node.inputs[kAddend]) == shape;
  Epilogue epilogue = has_addend && !is_sum ? Epilogue{} : ActivationOf(node);
  epilogue.sum = is_sum;
  const Layout bias = BiasLayout(node, weights[0], plan);
  const Primitive primitive = ConvolutionInBlocks(image, grouped, bias, shape, window, epilogue);
  const Place source = plan.In(node.inputs[0], primitive.source);
  const Place target =
      is_sum ? TargetWithAddend(node, primitive, shape, source, plan) : plan.NewOutput(node, shape, primitive.target);
  std::vector<PlanArgument> arguments = {
      {DNNL_ARG_SRC, primitive.source, source},
      {DNNL_ARG_WEIGHTS, primitive.weights, plan.Packed(node, 1, PlainLayout(grouped), primitive.weights)},
      {DNNL_ARG_DST, primitive.target, target}};
  AddBias(node, bias, plan, arguments);
  plan.AddPrimitive(node, primitive, std::move(arguments));
  if (has_addend && !is_sum) return AddRepeated(node, target, shape, primitive.target, plan);
  plan.Define(node, shape, primitive.target, target);
}

/// Of a transposed convolution: its output, and a window whose pads make it so large.
struct TransposedWindowAndOutput {
  Shape shape;
  Window window;
};

/// Pads cut off the output; those behind may be negative.
TransposedWindowAndOutput TransposedWindow(const GraphNode& node, const Shape& image, int64_t channels,
                                           const std::vector<int64_t>& kernel) {
  const size_t axes = kernel.size();
  Window window = WindowOf(node, kernel, image);
  const std::vector<int64_t> extra = node.Integers("output_padding", std::vector<int64_t>(axes, 0));
  std::vector<int64_t> wanted = node.Integers("output_shape", {});
  DAUMIER_CHECK(extra.size() == axes && (wanted.empty() || wanted.size() == axes || wanted.size() == axes + 2),
                "output_padding or output_shape is not of {} axes", axes);
  if (wanted.size() == axes + 2) wanted.erase(wanted.begin(), wanted.begin() + 2);
  const std::string auto_pad = node.Text("auto_pad", "NOTSET");
  if (wanted.empty() && auto_pad.starts_with("SAME"))
    for (size_t i = 0; i < axes; ++i) wanted.push_back(image[2 + i] * window.strides[i]);
  Shape shape = {image[0], channels};
  for (size_t i = 0; i < axes; ++i) {
    DAUMIER_CHECK(extra[i] >= 0 && extra[i] < std::max(window.strides[i], window.dilations[i]),
                  "output_padding is {}, expected less than the stride", extra[i]);
    const int64_t whole = (image[2 + i] - 1) * window.strides[i] + window.dilations[i] * (kernel[i] - 1) + 1;
    if (!wanted.empty()) {
      DAUMIER_CHECK(wanted[i] > 0 && wanted[i] <= whole + extra[i], "its output of {} pixels is none of {}", wanted[i],
                    whole + extra[i]);
      SetPads(window, i, whole + extra[i] - wanted[i], auto_pad == "SAME_UPPER");
    }
    window.after[i] -= extra[i];
    shape.push_back(whole - window.before[i] - window.after[i]);
    DAUMIER_CHECK(shape.back() > 0, "its output has the shape {}", ShapeText(shape));
  }
  return {shape, window};
}

/// ONNX stores weights as (I, O/G, ...).
void PlanTransposedConvolution(const GraphNode& node, PlanBuilder& plan) {
  const auto [image, groups, kernel] = SizesOfConvolution(node, plan);
  const Shape& weights = plan.Weight(node, 1).shape;
  DAUMIER_CHECK(image[1] == weights[0], "the image has {} channels, the weights are {}", image[1], ShapeText(weights));
  const auto [shape, window] = TransposedWindow(node, image, groups * weights[1], kernel);
  CheckedSize(shape, "its output");
  const int64_t inputs = weights[0] / groups;
  int64_t area = 1;
  for (const int64_t size : kernel) area *= size;
  Shape seen = {weights[1], inputs};
  std::vector<int64_t> strides = {area, weights[1] * area};
  if (groups > 1) {
    seen.insert(seen.begin(), groups);
    strides.insert(strides.begin(), inputs * weights[1] * area);
  }
  for (const int64_t size : kernel) {
    seen.push_back(size);
    area /= size;
    strides.push_back(area);
  }
  const Layout stored(seen, dnnl::memory::data_type::f32, strides), bias = BiasLayout(node, shape[1], plan);
  const Primitive primitive = MakeDeconvolution(AnyLayout(image), AnyLayout(seen), bias, AnyLayout(shape), window);
  const Place source = plan.In(node.inputs[0], primitive.source);
  const Place target = plan.NewOutput(node, shape, primitive.target);
  std::vector<PlanArgument> arguments = {
      {DNNL_ARG_SRC, primitive.source, source},
      {DNNL_ARG_WEIGHTS, primitive.weights, plan.Packed(node, 1, stored, primitive.weights)},
      {DNNL_ARG_DST, primitive.target, target}};
  AddBias(node, bias, plan, arguments);
  plan.AddPrimitive(node, primitive, std::move(arguments));
  plan.Define(node, shape, primitive.target, target);
}

/// One that follows no convolution: x scale + shift for each channel.
void PlanBatchNorm(const GraphNode& node, PlanBuilder& plan) {
  const Shape shape = plan.ShapeOf(node.inputs.at(0));
  DAUMIER_CHECK(shape.size() >= 2, "the input is {}, expected (N, C, ...)", ShapeText(shape));
  const auto channels = size_t(shape[1]);
  std::array<const std::vector<float>*, 4> stored;  // scale, shift, mean, variance
  for (size_t i = 0; i < 4; ++i) {
    stored[i] = &plan.Weight(node, i + 1).numbers;
    DAUMIER_CHECK(stored[i]->size() == channels, "input {} has {} numbers, expected {}", i + 1, stored[i]->size(),
                  channels);
  }
  std::vector<float> scales, shifts;
  const double epsilon = node.Real("epsilon", 1e-5f);
  for (size_t c = 0; c < channels; ++c) {
    const double scale = (*stored[0])[c] / std::sqrt((*stored[3])[c] + epsilon);
    DAUMIER_CHECK(std::isfinite(scale), "the variance of channel {} is {}", c, (*stored[3])[c]);
    scales.push_back(float(scale));
    shifts.push_back(float((*stored[1])[c] - scale * (*stored[2])[c]));
  }
  const Place from = plan.Plain(node.inputs[0]), to = plan.NewOutput(node, shape, PlainLayout(shape));
  const int64_t area = CheckedSize(shape, "its input") / (shape[0] * shape[1]);
  plan.AddOwn(node, std::array{from, to}, [=, batch = shape[0]](Arena& arena) {
    const float* source = arena.At(from);
    float* target = arena.At(to);
    for (int64_t n = 0; n < batch; ++n)
      for (size_t c = 0; c < scales.size(); ++c)
        for (int64_t i = 0; i < area; ++i) *target++ = *source++ * scales[c] + shifts[c];
  });
  plan.Define(node, shape, PlainLayout(shape), to);
}

/// Adds what a product cannot have as its bias.
void PlanGemm(const GraphNode& node, PlanBuilder& plan) {
  const Shape a = plan.ShapeOf(node.inputs.at(0)), b = plan.ShapeOf(node.inputs.at(1));
  DAUMIER_CHECK(a.size() == 2 && b.size() == 2 && node.Integer("transA", 0) == 0 && node.Real("alpha", 1) == 1 &&
                    node.Real("beta", 1) == 1,
                "expected two matrices, transA 0, alpha and beta 1");
  const bool transposed = node.Integer("transB", 0) != 0;
  const int64_t rows = a[0], inner = a[1], columns = transposed ? b[0] : b[1];
  DAUMIER_CHECK((transposed ? b[1] : b[0]) == inner, "the matrices are {} and {}", ShapeText(a), ShapeText(b));
  const Shape shape = {rows, columns};
  const Layout of_a = PlainLayout(a), target = PlainLayout(shape);
  const Layout of_b = transposed ? Layout({inner, columns}, dnnl::memory::data_type::f32, {1, inner}) : PlainLayout(b);
  Layout bias;
  Place of_bias;
  if (node.Reads(2)) {
    const GraphTensor& numbers = plan.Weight(node, 2);
    DAUMIER_CHECK(int64_t(numbers.numbers.size()) == columns && (numbers.shape.size() == 1 || numbers.shape[0] == 1),
                  "the bias is {}, expected ({})", ShapeText(numbers.shape), columns);
    bias = PlainLayout({1, columns});
    of_bias.constant = numbers.numbers.data();
  }
  const Primitive primitive = MakeProduct(of_a, of_b, bias, target, ActivationOf(node));
  const Place left = plan.Plain(node.inputs[0]), right = plan.Plain(node.inputs[1]),
              to = plan.NewOutput(node, shape, target);
  std::vector<PlanArgument> arguments = {
      {DNNL_ARG_SRC, of_a, left}, {DNNL_ARG_WEIGHTS, of_b, right}, {DNNL_ARG_DST, target, to}};
  if (node.Reads(2)) arguments.push_back({DNNL_ARG_BIAS, bias, of_bias});
  plan.AddPrimitive(node, primitive, std::move(arguments));
  plan.Define(node, shape, target, to);
}

/// Of matrices in the last two axes; axes before repeat. A single second matrix takes all rows of the first at once.
void PlanMatrixProduct(const GraphNode& node, PlanBuilder& plan) {
  Shape a = plan.ShapeOf(node.inputs.at(0)), b = plan.ShapeOf(node.inputs.at(1));
  DAUMIER_CHECK(a.size() >= 2 && b.size() >= 2 && a.back() == b[b.size() - 2], "the matrices are {} and {}",
                ShapeText(a), ShapeText(b));
  Shape shape = BroadcastShape({a.begin(), a.end() - 2}, {b.begin(), b.end() - 2});
  shape.insert(shape.end(), {a[a.size() - 2], b.back()});
  const int64_t size = CheckedSize(shape, "its output");
  Shape seen = shape;
  if (b.size() == 2) {
    a = {size / b[1], b[0]};
    seen = {a[0], b[1]};
  } else {
    a.insert(a.begin(), shape.size() - a.size(), 1);
    b.insert(b.begin(), shape.size() - b.size(), 1);
  }
  const Primitive primitive = MakeProduct(PlainLayout(a), PlainLayout(b), {}, PlainLayout(seen), {});
  const Place left = plan.Plain(node.inputs[0]), right = plan.Plain(node.inputs[1]),
              to = plan.NewOutput(node, shape, PlainLayout(shape));
  plan.AddPrimitive(node, primitive,
                    {{DNNL_ARG_SRC, PlainLayout(a), left},
                     {DNNL_ARG_WEIGHTS, PlainLayout(b), right},
                     {DNNL_ARG_DST, PlainLayout(seen), to}});
  plan.Define(node, shape, PlainLayout(shape), to);
}

}  // namespace

OperatorTable LayerOperators() {
  return {{"BatchNormalization", PlanBatchNorm},
          {"Conv", PlanConvolution},
          {"ConvTranspose", PlanTransposedConvolution},
          {"Gemm", PlanGemm},
          {"MatMul", PlanMatrixProduct}};
}

}  // namespace daumier::runtime
