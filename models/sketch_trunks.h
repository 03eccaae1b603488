#pragma once

#include <torch/nn/module.h>
#include <torch/nn/modules/container/sequential.h>
#include <torch/nn/modules/conv.h>
#include <torch/nn/pimpl.h>

#include <string>
#include <vector>

namespace daumier::models {

/// Which trunk, and its size. kind: one of SketchTrunkNames; resolution: side of the sketch in pixels; width: channels of
/// the first convolution; batch_norm: of alexnet alone; hidden: output features; shape_size: number of curve
/// coefficients, for trunk shape alone.
struct TrunkOptions {
  std::string kind;
  int resolution = 128;
  int width = 16;
  bool batch_norm = true;
  int hidden = 256;
  int shape_size = 0;
};

/// The part of a sketch network that comes before its branches, in two: what is frozen in the second step of training
/// [Han et al. 2017, section 4.4], and the fully connected layers after it, whose output has options.hidden features.
struct SketchTrunk {
  torch::nn::Sequential convolutions, features;
};

/// All convolutions are followed by batch norm (alexnet: if options.batch_norm) and ReLU.
///   compact   3 x 3 convolutions of stride 2 until the side is 4 or less, channels width, 2 width, ... up to 16 width
///   alexnet   [Krizhevsky et al. 2012] without groups, response normalisation and dropout: 11 x 11 of stride 4 and
///             padding 2, pooling, 5 x 5, pooling, three 3 x 3, pooling; channels 96-256-384-384-256 for width 96, all
///             in proportion; pooling is 3 x 3 of stride 2. 256 x 256 pixels give sides of 63-31-15-7, 128 x 128 give
///             31-15-7-3
///   residual  7 x 7 of stride 4, then residual blocks of two 3 x 3 [He et al. 2016], each of stride 2, channels
///             2 width, 4 width, 6 width, ... 6 width, until the side is 4 or less; 1 x 1 to width channels. The
///             fully connected layer reads the whole sketch
///   points    1 x 1 convolutions of the points, 2, 4 and 16 width channels, and their greatest values [Qi et al. 2017]
///   shape     nothing but the layer of features
/// @throws Error if there is no such trunk, or the picture is too small for it.
SketchTrunk MakeSketchTrunk(const TrunkOptions& options);

/// The kinds of trunks, the same as of sketch::TrunkKinds.
std::vector<std::string> SketchTrunkNames();

/// The same sketches (B, 1, H, W), marked as in plain layout; no pixel is copied. With one channel the two layouts have
/// the same bytes, and the mark decides in which of them LibTorch runs the convolutions.
torch::Tensor InPlainLayout(const torch::Tensor& sketches);

/// Stores the weights of a module's 2-D convolutions in the layout of channels-last convolutions, which otherwise copy
/// them in every pass; the numbers are the same. These convolutions then compute channels-last whatever their input is.
void StoreChannelsLast(torch::nn::Module& module);

/// The convolution of a sketch itself, in float32 regardless of tensor::Autocast: with one channel to read, LibTorch
/// takes several times as long for the gradient of its weights in bfloat16. The output has the type that Autocast
/// promises.
class SketchConvolutionImpl : public torch::nn::Conv2dImpl {
 public:
  using Conv2dImpl::Conv2dImpl;
  torch::Tensor forward(const torch::Tensor& sketches);
};
TORCH_MODULE(SketchConvolution);

/// Two 3 x 3 convolutions with a short cut around them, which is a 1 x 1 convolution where the shape changes.
class ResidualBlockImpl : public torch::nn::Module {
 public:
  ResidualBlockImpl(int from, int to, int stride);
  /// (B, from, H, W) -> (B, to, ceil(H / stride), ceil(W / stride)).
  torch::Tensor forward(const torch::Tensor& input);

 private:
  torch::nn::Sequential residual_{nullptr}, short_cut_{nullptr};
};
TORCH_MODULE(ResidualBlock);

/// (B, C, P) -> (B, C): the greatest of each channel, whatever the order of the points.
class GlobalMaxPoolImpl : public torch::nn::Module {
 public:
  torch::Tensor forward(const torch::Tensor& input) { return input.amax(2); }
};
TORCH_MODULE(GlobalMaxPool);

}  // namespace daumier::models
