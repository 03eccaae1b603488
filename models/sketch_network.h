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
/// The network predicts standardised coefficients; their means and deviations over the training identities and expressions are
/// buffers, as is the bilinear core, so that a checkpoint is whole.
class SketchNetworkImpl : public torch::nn::Module {
 public:
  SketchNetworkImpl(const PixelCnnOptions& options, const faces::BilinearModel& bilinear);

  /// images: (B, 1, R, R), ink = 1, paper = 0. @throws Error if the shape differs.
  FaceCoefficients forward(const torch::Tensor& images);
  /// (B, 3V) coordinates in cm.
  torch::Tensor Decode(const FaceCoefficients& coefficients) const;

  const PixelCnnOptions& options() const { return options_; }
  int64_t num_parameters() const;

 private:
  PixelCnnOptions options_;
  torch::nn::Sequential trunk_{nullptr}, identity_branch_{nullptr}, expression_branch_{nullptr};
  torch::Tensor u_mean_, u_deviation_, v_mean_, v_deviation_, core_;
};
TORCH_MODULE(SketchNetwork);

}  // namespace daumier::models
