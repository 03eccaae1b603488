#include "models/sketch_trunks.h"

#include "core/error.h"
#include "tensor/autocast.h"
#include "tensor/torch_version.h"

#include <torch/nn/modules/activation.h>
#include <torch/nn/modules/batchnorm.h>
#include <torch/nn/modules/linear.h>
#include <torch/nn/modules/pooling.h>

#include <fmt/ranges.h>

#include <algorithm>
#include <array>

namespace daumier::models {
namespace {

namespace nn = torch::nn;

constexpr int kLastSide = 4;
constexpr int kMaxWidening = 16;

nn::Conv2dOptions Shape(int from, int to, int kernel, int stride, int padding, bool bias = false) {
  return nn::Conv2dOptions(from, to, kernel).stride(stride).padding(padding).bias(bias);
}

/// No layer before it needs its own output for the gradient.
nn::ReLU ReluInPlace() {
  return nn::ReLU(nn::ReLUOptions(/*inplace=*/true));
}

/// A convolution; of one channel it is that of the sketch.
void PushConvolution(nn::Sequential& layers, const nn::Conv2dOptions& shape) {
  if (shape.in_channels() == 1) {
    layers->push_back(SketchConvolution(shape));
  } else {
    layers->push_back(nn::Conv2d(shape));
  }
}

void PushNormalised(nn::Sequential& layers, int from, int to, int kernel, int stride, int padding) {
  PushConvolution(layers, Shape(from, to, kernel, stride, padding));
  layers->push_back(nn::BatchNorm2d(to));
  layers->push_back(ReluInPlace());
}

nn::Sequential Features(int from, int hidden) {
  return nn::Sequential(nn::Flatten(), nn::Linear(from, hidden), ReluInPlace());
}

SketchTrunk Compact(const TrunkOptions& options) {
  nn::Sequential layers;
  int side = options.resolution, from = 1, to = options.width;
  while (side > kLastSide) {
    PushNormalised(layers, from, to, 3, 2, 1);
    side = (side + 1) / 2;
    from = to;
    to = std::min(2 * to, kMaxWidening * options.width);
  }
  return {layers, Features(from * side * side, options.hidden)};
}

SketchTrunk AlexNet(const TrunkOptions& options) {
  struct Layer {
    int channels, kernel, stride, padding;
    bool pooled;
  };
  constexpr std::array<Layer, 5> kLayers = {
      {{96, 11, 4, 2, true}, {256, 5, 1, 2, true}, {384, 3, 1, 1, false}, {384, 3, 1, 1, false}, {256, 3, 1, 1, true}}};
  nn::Sequential layers;
  int side = options.resolution, from = 1;
  for (const Layer& layer : kLayers) {
    const int to = std::max(1, layer.channels * options.width / kLayers[0].channels);
    PushConvolution(layers, Shape(from, to, layer.kernel, layer.stride, layer.padding, !options.batch_norm));
    if (options.batch_norm) layers->push_back(nn::BatchNorm2d(to));
    layers->push_back(ReluInPlace());
    side = (side + 2 * layer.padding - layer.kernel) / layer.stride + 1;
    if (layer.pooled) {
      DAUMIER_CHECK(side >= 3, "network.resolution={} is too small for network.trunk=\"alexnet\": 64 is the least",
                    options.resolution);
      layers->push_back(nn::MaxPool2d(nn::MaxPool2dOptions(3).stride(2)));
      side = (side - 3) / 2 + 1;
    }
    from = to;
  }
  return {layers, Features(from * side * side, options.hidden)};
}

SketchTrunk Residual(const TrunkOptions& options) {
  constexpr std::array<int, 3> kWidening = {2, 4, 6};
  nn::Sequential layers;
  PushNormalised(layers, 1, options.width, 7, 4, 3);
  int side = (options.resolution + 3) / 4, from = options.width;
  for (size_t stage = 0; side > kLastSide; ++stage) {
    const int to = kWidening[std::min(stage, kWidening.size() - 1)] * options.width;
    layers->push_back(ResidualBlock(from, to, 2));
    side = (side + 1) / 2;
    from = to;
  }
  const int last = options.width;
  PushNormalised(layers, from, last, 1, 1, 0);
  return {layers, Features(last * side * side, options.hidden)};
}

SketchTrunk Points(const TrunkOptions& options) {
  nn::Sequential layers;
  int from = 4;
  for (const int widening : {2, 4, 16}) {
    const int to = widening * options.width;
    layers->push_back(nn::Conv1d(nn::Conv1dOptions(from, to, 1).bias(false)));
    layers->push_back(nn::BatchNorm1d(to));
    layers->push_back(ReluInPlace());
    from = to;
  }
  layers->push_back(GlobalMaxPool());
  return {layers, Features(from, options.hidden)};
}

SketchTrunk FeaturesAlone(const TrunkOptions& options) {
  return {nn::Sequential(), Features(options.shape_size, options.hidden)};
}

struct TrunkRow {
  const char* name;
  SketchTrunk (*make)(const TrunkOptions& options);
};

/// A new trunk is a row here, and one of sketch::TrunkKinds.
constexpr TrunkRow kTrunks[] = {
    {"compact", Compact}, {"alexnet", AlexNet}, {"residual", Residual}, {"points", Points}, {"shape", FeaturesAlone},
};

}  // namespace

SketchTrunk MakeSketchTrunk(const TrunkOptions& options) {
  for (const TrunkRow& row : kTrunks)
    if (options.kind == row.name) return row.make(options);
  throw Error(fmt::format("there is no trunk '{}' (expected {})", options.kind, fmt::join(SketchTrunkNames(), ", ")));
}

std::vector<std::string> SketchTrunkNames() {
  std::vector<std::string> names;
  for (const TrunkRow& row : kTrunks) names.emplace_back(row.name);
  return names;
}

torch::Tensor InPlainLayout(const torch::Tensor& sketches) {
  return sketches.squeeze(1).unsqueeze(1);
}

void StoreChannelsLast(nn::Module& module) {
  const at::NoGradGuard no_grad;
  for (torch::Tensor& parameter : module.parameters())
    if (parameter.dim() == 4) parameter.set_data(parameter.contiguous(torch::MemoryFormat::ChannelsLast));
}

torch::Tensor SketchConvolutionImpl::forward(const torch::Tensor& sketches) {
  const bool reduced = tensor::Autocast::IsOn(sketches.device());
  const tensor::Autocast full(sketches.device(), false);
  const torch::Tensor output = Conv2dImpl::forward(sketches);
  return reduced ? output.to(torch::kBFloat16) : output;
}

ResidualBlockImpl::ResidualBlockImpl(int from, int to, int stride) {
  residual_ = register_module(
      "residual", nn::Sequential(nn::Conv2d(Shape(from, to, 3, stride, 1)), nn::BatchNorm2d(to), ReluInPlace(),
                                 nn::Conv2d(Shape(to, to, 3, 1, 1)), nn::BatchNorm2d(to)));
  if (from != to || stride != 1)
    short_cut_ =
        register_module("short_cut", nn::Sequential(nn::Conv2d(Shape(from, to, 1, stride, 0)), nn::BatchNorm2d(to)));
}

torch::Tensor ResidualBlockImpl::forward(const torch::Tensor& input) {
  return residual_->forward(input).add_(short_cut_ ? short_cut_->forward(input) : input).relu_();
}

}  // namespace daumier::models
