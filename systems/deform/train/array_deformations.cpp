#include "systems/deform/train/array_deformations.h"

#include "tensor/shape.h"
#include "tensor/torch_version.h"

namespace daumier::deform {

torch::Tensor VertexDeformation::Positions(const torch::Tensor& codes, const SurfacePoints& points) {
  const torch::Tensor vertices = Vertices(codes);
  // All vertices in order need no gathering.
  if (points.positions.is_same(template_vertices())) return vertices;
  const int64_t num_codes = codes.size(0), num_points = points.positions.size(-2);
  const torch::Tensor corners = points.corners.expand({num_codes, num_points, 3}).reshape({num_codes, -1, 1});
  const torch::Tensor found = vertices.gather(1, corners.expand({-1, -1, 3})).reshape({num_codes, num_points, 3, 3});
  return (found * points.weights.unsqueeze(-1)).sum(2);
}

ArrayDeformation::ArrayDeformation(const DeformOptions& options, const torch::Tensor& template_vertices,
                                   const faces::ModelFrame& frame)
    : VertexDeformation(options, template_vertices, frame),
      hidden_(register_module("hidden", torch::nn::Linear(options.latent, options.array_width))),
      output_(register_module("output", torch::nn::Linear(options.array_width, 3 * num_vertices()))) {}

torch::Tensor ArrayDeformation::Vertices(const torch::Tensor& codes) {
  const torch::Tensor numbers =
      output_->forward(torch::leaky_relu(hidden_->forward(codes), 0.1)).reshape({-1, num_vertices(), 3});
  return options().kind == "positions" ? numbers : numbers + template_vertices();
}

LinearDeformation::LinearDeformation(const DeformOptions& options, const torch::Tensor& template_vertices,
                                     const faces::ModelFrame& frame)
    : VertexDeformation(options, template_vertices, frame) {
  mean_ = register_buffer("mean", template_vertices.reshape({-1}).to(torch::kFloat32).clone());
  rows_ = register_buffer("rows", torch::zeros({options.latent, 3 * num_vertices()}));
}

void LinearDeformation::Set(const torch::Tensor& mean, const torch::Tensor& rows) {
  tensor::CheckShape(mean, mean_.sizes(), "mean");
  tensor::CheckShape(rows, rows_.sizes(), "rows");
  const at::NoGradGuard no_grad;
  mean_.copy_(mean);
  rows_.copy_(rows);
}

torch::Tensor LinearDeformation::Vertices(const torch::Tensor& codes) {
  return (mean_ + torch::matmul(codes, rows_)).reshape({-1, num_vertices(), 3});
}

}  // namespace daumier::deform
