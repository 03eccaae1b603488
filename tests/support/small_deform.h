#pragma once
#include "tests/support/deform_networks.h"

#include <memory>
#include <string>
#include <torch/utils.h>

namespace daumier::testing {

/// A small network of a kind around a template, whose surfaces move by some tenths under codes of that size and follow
/// them smoothly. The same on every call.
inline std::shared_ptr<deform::DeformNetwork> SmoothDeformNetwork(const std::string& kind,
                                                                  const torch::Tensor& template_vertices,
                                                                  const faces::ModelFrame& frame = {}) {
  torch::manual_seed(3);
  deform::DeformOptions options = SmallDeformOptions(kind);
  options.omega = 3;
  auto network = deform::MakeDeformNetwork(options, template_vertices, frame);
  const torch::NoGradGuard no_gradient;
  // The first weights of a hypernetwork hardly hear the code; those of a linear model are zero.
  for (auto& [name, parameter] : network->named_parameters().pairs())
    if (name.ends_with("last.weight")) parameter.mul_(20);
  for (auto& [name, buffer] : network->named_buffers().pairs())
    if (name == "rows") buffer.normal_(0, 0.3);
  network->eval();
  return network;
}

/// `num_vertices` points on the unit sphere, (V, 3).
inline torch::Tensor SpherePoints(int64_t num_vertices) {
  torch::manual_seed(5);
  const torch::Tensor points = torch::randn({num_vertices, 3});
  return points / points.norm(2, {1}, true);
}

}  // namespace daumier::testing
