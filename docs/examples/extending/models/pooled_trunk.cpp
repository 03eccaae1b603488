#include "models/pooled_trunk.h"

#include <torch/nn/modules/activation.h>
#include <torch/nn/modules/batchnorm.h>
#include <torch/nn/modules/linear.h>
#include <torch/nn/modules/pooling.h>

namespace daumier::models {

SketchTrunk PooledTrunk(const TrunkOptions& options) {
  namespace nn = torch::nn;
  const auto shape = [](int from, int to) { return nn::Conv2dOptions(from, to, 3).stride(2).padding(1).bias(false); };
  const int width = options.width;
  nn::Sequential layers(SketchConvolution(shape(1, width)), nn::BatchNorm2d(width), nn::ReLU());
  for (const int from : {width, 2 * width}) {
    layers->push_back(nn::Conv2d(shape(from, 2 * from)));
    layers->push_back(nn::BatchNorm2d(2 * from));
    layers->push_back(nn::ReLU());
  }
  layers->push_back(nn::AdaptiveAvgPool2d(1));
  return {layers, nn::Sequential(nn::Flatten(), nn::Linear(4 * width, options.hidden), nn::ReLU())};
}

}  // namespace daumier::models
