#include "systems/deform/train/surface_decoder.h"

#include "core/error.h"
#include "models/siren_field.h"
#include "systems/deform/train/siren_deformations.h"
#include "tensor/eigen.h"
#include "tensor/shape.h"
#include "tensor/torch_version.h"

namespace daumier::deform {
namespace {

torch::Tensor Subdivided(const torch::Tensor& vertices, const geometry::Subdivider& subdivider) {
  const geometry::Points points = tensor::CopyToMatrix<double>(vertices);
  return tensor::CopyToTensor(subdivider.Apply(points)).to(vertices.options());
}

}  // namespace

SurfaceDecoder::SurfaceDecoder(std::shared_ptr<DeformNetwork> network, const torch::Tensor& code)
    : network_(std::move(network)), code_(code) {
  tensor::CheckShape(code, {network_->options().latent}, "code");
  const at::NoGradGuard no_grad;
  if (auto* const siren = dynamic_cast<SirenDeformation*>(network_.get()))
    siren_parameters_ = siren->SirenParameters(code.unsqueeze(0));
}

torch::Tensor SurfaceDecoder::Vertices() const {
  const at::NoGradGuard no_grad;
  if (!siren_parameters_.defined()) return network_->DeformVertices(code_.unsqueeze(0))[0];
  const torch::Tensor& vertices = network_->template_vertices();
  return vertices + models::SirenField(network_->options().siren(), siren_parameters_, vertices)[0];
}

torch::Tensor SurfaceDecoder::Vertices(const geometry::Subdivider& subdivider,
                                       const torch::Tensor& template_vertices) const {
  tensor::CheckShape(template_vertices, {subdivider.num_vertices(), 3}, "template_vertices");
  const at::NoGradGuard no_grad;
  if (!siren_parameters_.defined()) return Subdivided(Vertices(), subdivider);
  return models::SirenField(network_->options().siren(), siren_parameters_, template_vertices)[0].add_(
      template_vertices);
}

torch::Tensor SubdividedTemplate(const DeformNetwork& network, const geometry::Subdivider& subdivider) {
  return Subdivided(network.template_vertices(), subdivider);
}

}  // namespace daumier::deform
