#pragma once
#include <torch/nn/module.h>
#include <torch/nn/modules/container/sequential.h>
#include <torch/nn/modules/linear.h>
#include <torch/nn/pimpl.h>

#include <string>

namespace daumier::models {

/// A residual network [He et al. 2016] that regresses numbers from a picture. depth: 18 (two blocks of two 3 x 3
/// convolutions a stage) or 50 (3, 4, 6, 3 bottlenecks with the stride in the 3 x 3 convolution, "v1.5"); resolution:
/// side of the picture; width: channels of the first convolution, 64 as published; outputs: numbers.
struct ResidualNetworkOptions {
  int depth = 50;
  int resolution = 224;
  int width = 64;
  int outputs = 239;
};

/// (B, 3, R, R) colours 0 .. 1 -> (B, outputs). 7 x 7 convolution of stride 2, 3 x 3 maximum of stride 2, four stages of
/// width, 2 width, 4 width and 8 width channels (four times as many behind a bottleneck), of which all but the first
/// halve the side, their mean, one fully connected layer. Every convolution is followed by batch norm. The fully
/// connected layer begins with zeros: every picture has the output 0 at first. The others are drawn by Kaiming's rule
/// from LibTorch's CPU generator, and the last norm of a block begins with the factor 0.
class ResidualNetworkImpl : public torch::nn::Module {
 public:
  /// @throws Error if the depth is neither 18 nor 50, or the resolution is no multiple of 32.
  explicit ResidualNetworkImpl(const ResidualNetworkOptions& options);

  /// @throws Error if the pictures have another shape.
  torch::Tensor forward(const torch::Tensor& pictures);
  /// What the fully connected layer reads, (B, 8 width) or (B, 32 width).
  torch::Tensor Features(const torch::Tensor& pictures);

  const ResidualNetworkOptions& options() const { return options_; }
  int64_t num_parameters() const;

 private:
  const ResidualNetworkOptions options_;
  torch::nn::Sequential stem_{nullptr}, stages_{nullptr};
  torch::nn::Linear head_{nullptr};
};
TORCH_MODULE(ResidualNetwork);

}  // namespace daumier::models
