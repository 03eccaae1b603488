#include "systems/sketch/train/gesture_network.h"

#include "systems/sketch/gesture_recogniser.h"

#include <torch/nn/modules/activation.h>
#include <torch/nn/modules/batchnorm.h>
#include <torch/nn/modules/conv.h>
#include <torch/nn/modules/linear.h>
#include <torch/nn/modules/pooling.h>

namespace daumier::sketch {
namespace {

namespace nn = torch::nn;

constexpr int kLastSide = 5, kCompactHidden = 96;
constexpr int kPaperLastSide = 8, kPaperHidden = 256;

void PushHead(nn::Sequential& layers, int inputs, int hidden) {
  layers->push_back(nn::Flatten());
  layers->push_back(nn::Linear(inputs, hidden));
  layers->push_back(nn::ReLU());
  layers->push_back(nn::Linear(hidden, kNumGestureClasses));
}

nn::Sequential PaperNetwork() {
  nn::Sequential layers;
  struct Layer {
    int from, to, kernel;
  };
  constexpr Layer kLayers[] = {{1, 32, 11}, {32, 64, 5}, {64, 16, 3}};
  for (const Layer& layer : kLayers) {
    layers->push_back(nn::Conv2d(nn::Conv2dOptions(layer.from, layer.to, layer.kernel)));
    layers->push_back(nn::ReLU());
    layers->push_back(nn::MaxPool2d(nn::MaxPool2dOptions(3)));
  }
  PushHead(layers, kLayers[2].to * kPaperLastSide * kPaperLastSide, kPaperHidden);
  return layers;
}

nn::Sequential CompactNetwork() {
  nn::Sequential layers;
  const auto push = [&](const nn::Conv2dOptions& convolution) {
    layers->push_back(nn::Conv2d(convolution));
    layers->push_back(nn::BatchNorm2d(convolution.out_channels()));
    layers->push_back(nn::ReLU());
  };
  push(nn::Conv2dOptions(1, 16, 5).stride(2).padding(2).bias(false));
  int from = 16;
  for (const int to : {32, 48, 64}) {
    push(nn::Conv2dOptions(from, to, 3).padding(1).bias(false));
    layers->push_back(nn::MaxPool2d(nn::MaxPool2dOptions(2)));
    from = to;
  }
  PushHead(layers, from * kLastSide * kLastSide, kCompactHidden);
  return layers;
}

}  // namespace

nn::Sequential MakeGestureNetwork(const GestureNetworkOptions& options) {
  return options.kind == "paper" ? PaperNetwork() : CompactNetwork();
}

int64_t NumParameters(const nn::Module& module) {
  int64_t count = 0;
  for (const torch::Tensor& parameter : module.parameters()) count += parameter.numel();
  return count;
}

}  // namespace daumier::sketch
