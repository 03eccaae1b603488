#pragma once
#include "systems/deform/train/network.h"

#include <torch/nn/modules/linear.h>

namespace daumier::deform {

/// A network that predicts vertices alone; a point in a triangle is interpolated from its corners.
class VertexDeformation : public DeformNetwork {
 public:
  using DeformNetwork::DeformNetwork;

 protected:
  /// (B, V, 3).
  virtual torch::Tensor Vertices(const torch::Tensor& codes) = 0;
  torch::Tensor Positions(const torch::Tensor& codes, const SurfacePoints& points) override;
};

/// latent -> array_width -> 3V with leaky ReLU of slope 0.1 between [Jung et al. 2022, supplement 3]: vertex positions,
/// or displacements from the template.
class ArrayDeformation : public VertexDeformation {
 public:
  ArrayDeformation(const DeformOptions& options, const torch::Tensor& template_vertices,
                   const faces::ModelFrame& frame);

 protected:
  torch::Tensor Vertices(const torch::Tensor& codes) override;

 private:
  torch::nn::Linear hidden_, output_;
};

/// mean + code * rows: a linear model by principal components. Has no parameter that is trained by steps.
class LinearDeformation : public VertexDeformation {
 public:
  LinearDeformation(const DeformOptions& options, const torch::Tensor& template_vertices,
                    const faces::ModelFrame& frame);
  /// mean: (3V), rows: (latent, 3V), model units. @throws Error if a shape disagrees.
  void Set(const torch::Tensor& mean, const torch::Tensor& rows);

 protected:
  torch::Tensor Vertices(const torch::Tensor& codes) override;

 private:
  torch::Tensor mean_, rows_;
};

}  // namespace daumier::deform
