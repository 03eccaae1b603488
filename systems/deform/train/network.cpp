#include "systems/deform/train/network.h"

#include "core/error.h"
#include "runtime/block_product.h"
#include "systems/deform/train/array_deformations.h"
#include "systems/deform/train/siren_deformations.h"
#include "tensor/shape.h"

namespace daumier::deform {

SurfacePoints VerticesAsPoints(const torch::Tensor& vertices) {
  tensor::CheckShape(vertices, {tensor::kAny, 3}, "vertices");
  const torch::Tensor indices =
      torch::arange(vertices.size(0), torch::TensorOptions(torch::kInt64).device(vertices.device()));
  torch::Tensor weights = torch::zeros_like(vertices);
  weights.select(1, 0).fill_(1);
  return {indices.unsqueeze(1).expand({-1, 3}), weights, vertices};
}

DeformNetwork::DeformNetwork(const DeformOptions& options, const torch::Tensor& template_vertices,
                             const faces::ModelFrame& frame)
    : options_(options) {
  tensor::CheckShape(template_vertices, {tensor::kAny, 3}, "template_vertices");
  template_vertices_ = register_buffer("template_vertices", template_vertices.to(torch::kFloat32).contiguous().clone());
  model_from_cm_ = register_buffer(
      "model_from_cm",
      torch::tensor({frame.scale, frame.offset.x(), frame.offset.y(), frame.offset.z()}, torch::kFloat64));
}

torch::Tensor DeformNetwork::Deform(const torch::Tensor& codes, const SurfacePoints& points) {
  tensor::CheckShape(codes, {tensor::kAny, options_.latent}, "codes");
  if (points.positions.dim() == 3) {
    tensor::CheckShape(points.positions, {codes.size(0), tensor::kAny, 3}, "points.positions");
  } else {
    tensor::CheckShape(points.positions, {tensor::kAny, 3}, "points.positions");
  }
  return Positions(codes, points);
}

torch::Tensor DeformNetwork::DeformVertices(const torch::Tensor& codes) {
  return Deform(codes, VerticesAsPoints(template_vertices_));
}

faces::ModelFrame DeformNetwork::frame() const {
  const torch::Tensor numbers = model_from_cm_.to(torch::kCPU);
  const double* const n = numbers.data_ptr<double>();
  return {n[0], {n[1], n[2], n[3]}};
}

int64_t DeformNetwork::num_parameters() const {
  int64_t count = 0;
  for (const torch::Tensor& parameter : parameters()) count += parameter.numel();
  return count;
}

std::shared_ptr<DeformNetwork> MakeDeformNetwork(const DeformOptions& options, const torch::Tensor& template_vertices,
                                                 const faces::ModelFrame& frame) {
  DAUMIER_CHECK(options.is_array() || options.width % runtime::kProductColumns == 0,
                "network.width is {}, expected a multiple of {}", options.width, runtime::kProductColumns);
  if (options.kind == "hypernetwork")
    return std::make_shared<HypernetworkDeformation>(options, template_vertices, frame);
  if (options.kind == "conditioning")
    return std::make_shared<ConditionedDeformation>(options, template_vertices, frame);
  if (options.kind == "linear") return std::make_shared<LinearDeformation>(options, template_vertices, frame);
  DAUMIER_CHECK(options.is_array(), "there is no deformable model of kind '{}'", options.kind);
  return std::make_shared<ArrayDeformation>(options, template_vertices, frame);
}

}  // namespace daumier::deform
