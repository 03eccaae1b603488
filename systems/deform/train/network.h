#pragma once
#include "faces/model_frame.h"
#include "systems/deform/network_options.h"

#include <torch/nn/module.h>

#include <memory>

namespace daumier::deform {

/// Points of a template, N for all codes or B x N: of each the triangle's corners (.., N, 3) int64, their weights
/// (.., N, 3), and the position (.., N, 3) in the model's frame. A vertex v has the corners v, v, v with weights 1, 0,
/// 0.
struct SurfacePoints {
  torch::Tensor corners, weights, positions;
};

/// All vertices of a template, in order. vertices: (V, 3).
SurfacePoints VerticesAsPoints(const torch::Tensor& vertices);

/// A deformable surface: codes -> where points of the template go. One class a kind: models/siren_deformations.h,
/// models/array_deformations.h.
class DeformNetwork : public torch::nn::Module {
 public:
  /// template_vertices: (V, 3) in the model's frame, mouth open.
  DeformNetwork(const DeformOptions& options, const torch::Tensor& template_vertices, const faces::ModelFrame& frame);

  /// Positions (B, N, 3) in the model's frame of points under codes (B, M). @throws Error if a shape disagrees.
  torch::Tensor Deform(const torch::Tensor& codes, const SurfacePoints& points);
  /// The same of all vertices, (B, V, 3).
  torch::Tensor DeformVertices(const torch::Tensor& codes);

  const DeformOptions& options() const { return options_; }
  const torch::Tensor& template_vertices() const { return template_vertices_; }
  int64_t num_vertices() const { return template_vertices_.size(0); }
  /// Kept among the weights as model_from_cm = (scale, offset).
  faces::ModelFrame frame() const;
  int64_t num_parameters() const;

 protected:
  virtual torch::Tensor Positions(const torch::Tensor& codes, const SurfacePoints& points) = 0;

 private:
  const DeformOptions options_;
  torch::Tensor template_vertices_, model_from_cm_;
};

/// The network that options.kind names, with first weights from LibTorch's CPU generator. A linear one is zero until
/// LinearDeformation::Set. @throws Error if the width of a SIREN is not one that runtime::SirenKernel takes.
std::shared_ptr<DeformNetwork> MakeDeformNetwork(const DeformOptions& options, const torch::Tensor& template_vertices,
                                                 const faces::ModelFrame& frame);

}  // namespace daumier::deform
