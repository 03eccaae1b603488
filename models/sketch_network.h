#pragma once
#include "core/options.h"
#include "faces/bilinear_model.h"

#include <torch/nn.h>

namespace daumier::models {

struct PixelCnnOptions {
  int resolution = 128;
  int width = 16;
  int hidden = 256;

  template <class V>
  void Visit(V&& visit) {
    visit("resolution", resolution, Range{32, 512}, "Side of the square sketch that the network sees, in pixels.");
    visit("width", width, Range{1, 256}, "Channels of the first convolution; doubled as the resolution is halved.");
    visit("hidden", hidden, Range{1, 8192}, "Neurons of the fully connected layers.");
  }
};

/// u: (B, Ku), v: (B, Kv) of the bilinear model, in its own units.
struct FaceCoefficients {
  torch::Tensor u, v;
};

/// A compact PixelCNN [Han et al. 2017, section 4.3, the row without shape input]: sketch -> u, v in two branches.
///   trunk       3 x 3 convolutions of stride 2 (batch norm, ReLU) until the side is 4 or less, channels width, 2
///   width, ... up to
///               16 width; then one fully connected layer (ReLU)
///   u branch    three fully connected layers, ReLU between them
///   v branch    one fully connected layer
/// The branches answer standardised coefficients; u = mean + deviation * answer, over the training identities, and v
/// over the training expressions. Means, deviations and the bilinear core are buffers, so that a checkpoint is whole.
class SketchNetworkImpl : public torch::nn::Module {
 public:
  SketchNetworkImpl(const PixelCnnOptions& options, const faces::BilinearModel& bilinear);

  /// images: (B, 1, R, R), ink = 1, paper = 0. @throws Error if the shape differs.
  FaceCoefficients forward(const torch::Tensor& images);
  /// (B, 3V) coordinates in cm: C x2 u x3 v. @throws Error if the shapes disagree with the core.
  torch::Tensor Decode(const FaceCoefficients& coefficients) const;

  const PixelCnnOptions& options() const { return options_; }
  /// Trained numbers; buffers do not count.
  int64_t num_parameters() const;
  int64_t num_identity() const { return u_mean_.size(0); }
  int64_t num_expression() const { return v_mean_.size(0); }
  int64_t num_vertices() const { return core_.size(1) / 3; }
  /// (Ku * Kv, 3V), the core that Decode uses; on the network's device.
  const torch::Tensor& core() const { return core_; }

 private:
  PixelCnnOptions options_;
  torch::nn::Sequential trunk_{nullptr}, identity_branch_{nullptr}, expression_branch_{nullptr};
  torch::Tensor u_mean_, u_deviation_, v_mean_, v_deviation_, core_;
};
TORCH_MODULE(SketchNetwork);

}  // namespace daumier::models
