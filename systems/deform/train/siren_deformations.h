#pragma once
#include "systems/deform/train/network.h"

#include <torch/nn/modules/linear.h>

#include <vector>

namespace daumier::deform {

/// A network whose code becomes the parameters of a SIREN, which displaces the template's points [Jung et al. 2022,
/// eq. 2].
class SirenDeformation : public DeformNetwork {
 public:
  using DeformNetwork::DeformNetwork;
  /// Of codes (B, M): (B, options.siren().num_parameters()).
  virtual torch::Tensor SirenParameters(const torch::Tensor& codes) = 0;

 protected:
  torch::Tensor Positions(const torch::Tensor& codes, const SurfacePoints& points) override;
};

/// latent -> width -> width -> outputs, with ReLU between. First weights: Kaiming normal; those of the last layer a
/// hundredth of that, with biases U(+-last_bias), so that all codes begin with about the same outputs.
class HypernetworkBranchImpl : public torch::nn::Module {
 public:
  HypernetworkBranchImpl(int latent, int width, int64_t outputs, double last_bias);
  torch::Tensor forward(const torch::Tensor& codes);

 private:
  torch::nn::Linear first_, second_, last_;
};
TORCH_MODULE(HypernetworkBranch);

/// A branch for the weights and one for the biases of every layer. As the authors' program begins, last_bias is 1/3 for
/// the weights of layer 0, 1/width for those of the others, 1/hyper_width for biases.
class HypernetworkDeformation : public SirenDeformation {
 public:
  HypernetworkDeformation(const DeformOptions& options, const torch::Tensor& template_vertices,
                          const faces::ModelFrame& frame);
  torch::Tensor SirenParameters(const torch::Tensor& codes) override;

 private:
  std::vector<HypernetworkBranch> branches_;  ///< Of w0, b0, w1, b1, ...
};

/// One SIREN for all codes. The code is concatenated to the input of layer 0 and of the middle layer [Jung et al. 2022,
/// section 4.2], which is equivalent to a shift of their biases. First weights: U(+-1/3) for layer 0 and for the code,
/// U(+-sqrt(6 / width) / omega) for the others [Sitzmann et al. 2020], biases U(+-1/sqrt(inputs)) / omega.
class ConditionedDeformation : public SirenDeformation {
 public:
  ConditionedDeformation(const DeformOptions& options, const torch::Tensor& template_vertices,
                         const faces::ModelFrame& frame);
  torch::Tensor SirenParameters(const torch::Tensor& codes) override;

 private:
  torch::Tensor shared_;                 ///< (P)
  torch::Tensor first_code_, mid_code_;  ///< (width, M)
};

}  // namespace daumier::deform
