#pragma once
#include "models/deform_network.h"

#include <torch/utils.h>

#include <memory>
#include <string>
#include <vector>

namespace daumier::testing {

/// Every kind of deformable model.
inline std::vector<std::string> DeformKinds() {
  return {"hypernetwork", "conditioning", "displacements", "positions", "linear"};
}

/// A small network of a kind around a template whose surfaces move by some tenths under codes of that size. The same on
/// every call.
inline std::shared_ptr<models::DeformNetwork> SmallDeformNetwork(const std::string& kind,
                                                                 const torch::Tensor& template_vertices,
                                                                 const faces::ModelFrame& frame = {}, int latent = 4) {
  torch::manual_seed(3);
  // A low frequency, so that surfaces follow codes smoothly.
  const models::DeformOptions options{.kind = kind,
                                      .latent = latent,
                                      .width = 32,
                                      .hidden_layers = 1,
                                      .omega = 3,
                                      .hyper_width = 16,
                                      .array_width = 16};
  auto network = models::MakeDeformNetwork(options, template_vertices, frame);
  const torch::NoGradGuard no_gradient;
  // First weights hardly hear the code.
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
