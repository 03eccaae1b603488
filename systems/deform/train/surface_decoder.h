#pragma once
#include "geometry/subdivision.h"
#include "systems/deform/train/network.h"

#include <memory>

namespace daumier::deform {

/// The surface of one code at any resolution. What depends on the code alone (the parameters that a hypernetwork makes)
/// is computed once; the memory that a SIREN needs in addition to its result does not grow with the points.
class SurfaceDecoder {
 public:
  /// code: (M). @throws Error if its shape disagrees.
  SurfaceDecoder(std::shared_ptr<DeformNetwork> network, const torch::Tensor& code);

  /// (V, 3), model units: DeformNetwork::DeformVertices of the code.
  torch::Tensor Vertices() const;
  /// The vertices of a subdivided template, (subdivider.num_vertices(), 3): a SIREN is evaluated at each of them, an
  /// array interpolates its vertices. template_vertices: those of the network, subdivided, (.., 3).
  torch::Tensor Vertices(const geometry::Subdivider& subdivider, const torch::Tensor& template_vertices) const;

 private:
  std::shared_ptr<DeformNetwork> network_;
  torch::Tensor code_, siren_parameters_;
};

/// The template's vertices of a network, subdivided: (subdivider.num_vertices(), 3).
torch::Tensor SubdividedTemplate(const DeformNetwork& network, const geometry::Subdivider& subdivider);

}  // namespace daumier::deform
