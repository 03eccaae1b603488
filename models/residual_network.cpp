#include "models/residual_network.h"

#include "core/error.h"
#include "tensor/shape.h"

#include <torch/nn/init.h>
#include <torch/nn/modules/activation.h>
#include <torch/nn/modules/batchnorm.h>
#include <torch/nn/modules/conv.h>
#include <torch/nn/modules/pooling.h>

#include <array>

namespace daumier::models {
namespace {

using torch::nn::BatchNorm2d;
using torch::nn::Conv2d;
using torch::nn::ReLU;
using torch::nn::Sequential;

Conv2d PlainConvolution(int from, int to, int side, int stride) {
  Conv2d convolution(torch::nn::Conv2dOptions(from, to, side).stride(stride).padding(side / 2).bias(false));
  torch::nn::init::kaiming_normal_(convolution->weight, 0, torch::kFanOut, torch::kReLU);
  return convolution;
}

/// A block's last norm: the block begins as its short cut.
BatchNorm2d SilentNorm(int channels) {
  BatchNorm2d norm(channels);
  torch::nn::init::zeros_(norm->weight);
  return norm;
}

class PictureBlockImpl : public torch::nn::Module {
 public:
  /// `wide`: the channels of its output; bottleneck: `inner` channels are a quarter of them.
  PictureBlockImpl(int from, int inner, int wide, int stride, bool bottleneck) {
    residual_ = bottleneck ? Sequential(PlainConvolution(from, inner, 1, 1), BatchNorm2d(inner), ReLU(),
                                        PlainConvolution(inner, inner, 3, stride), BatchNorm2d(inner), ReLU(),
                                        PlainConvolution(inner, wide, 1, 1), SilentNorm(wide))
                           : Sequential(PlainConvolution(from, inner, 3, stride), BatchNorm2d(inner), ReLU(),
                                        PlainConvolution(inner, wide, 3, 1), SilentNorm(wide));
    register_module("residual", residual_);
    if (stride != 1 || from != wide)
      short_cut_ = register_module("short_cut", Sequential(PlainConvolution(from, wide, 1, stride), BatchNorm2d(wide)));
  }
  torch::Tensor forward(const torch::Tensor& input) {
    const torch::Tensor kept = short_cut_.is_empty() ? input : short_cut_->forward(input);
    return torch::relu(residual_->forward(input) + kept);
  }

 private:
  Sequential residual_{nullptr}, short_cut_{nullptr};
};
TORCH_MODULE(PictureBlock);

}  // namespace

ResidualNetworkImpl::ResidualNetworkImpl(const ResidualNetworkOptions& options) : options_(options) {
  DAUMIER_CHECK(options.depth == 18 || options.depth == 50, "a residual network of depth {}, expected 18 or 50",
                options.depth);
  DAUMIER_CHECK(options.resolution > 0 && options.resolution % 32 == 0,
                "a residual network for pictures of side {}, expected a multiple of 32", options.resolution);
  const bool bottleneck = options.depth == 50;
  const std::array<int, 4> blocks = bottleneck ? std::array{3, 4, 6, 3} : std::array{2, 2, 2, 2};
  const int expansion = bottleneck ? 4 : 1;
  stem_ =
      register_module("stem", Sequential(PlainConvolution(3, options.width, 7, 2), BatchNorm2d(options.width), ReLU(),
                                         torch::nn::MaxPool2d(torch::nn::MaxPool2dOptions(3).stride(2).padding(1))));
  stages_ = register_module("stages", Sequential());
  int channels = options.width;
  for (int stage = 0; stage < 4; ++stage) {
    const int inner = options.width << stage, wide = expansion * inner;
    for (int block = 0; block < blocks[size_t(stage)]; ++block) {
      stages_->push_back(PictureBlock(channels, inner, wide, block == 0 && stage > 0 ? 2 : 1, bottleneck));
      channels = wide;
    }
  }
  head_ = register_module("head", torch::nn::Linear(channels, options.outputs));
  torch::nn::init::zeros_(head_->weight);
  torch::nn::init::zeros_(head_->bias);
}

torch::Tensor ResidualNetworkImpl::Features(const torch::Tensor& pictures) {
  tensor::CheckShape(pictures, {tensor::kAny, 3, options_.resolution, options_.resolution}, "pictures");
  constexpr double kMeanColour = 0.5, kSpread = 0.25;
  const torch::Tensor input = (pictures - kMeanColour) * (1 / kSpread);
  return stages_->forward(stem_->forward(input)).mean({2, 3});
}

torch::Tensor ResidualNetworkImpl::forward(const torch::Tensor& pictures) {
  return head_->forward(Features(pictures));
}

int64_t ResidualNetworkImpl::num_parameters() const {
  int64_t count = 0;
  for (const torch::Tensor& parameter : parameters()) count += parameter.numel();
  return count;
}

}  // namespace daumier::models
