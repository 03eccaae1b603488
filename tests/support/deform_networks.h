#pragma once
#include "systems/deform/train/network.h"

#include <torch/optim.h>
#include <torch/utils.h>

#include <string>
#include <vector>

namespace daumier::testing {

inline const std::vector<std::string>& DeformKinds() {
  static const std::vector<std::string> kinds = {"hypernetwork", "conditioning", "displacements", "positions",
                                                 "linear"};
  return kinds;
}

/// Codes of 8 numbers, a SIREN of three layers of 32.
inline deform::DeformOptions SmallDeformOptions(const std::string& kind) {
  return {.kind = kind, .latent = 8, .width = 32, .hidden_layers = 2, .hyper_width = 32, .array_width = 32};
}

/// Twelve vertices of about the extent of a head.
inline torch::Tensor SomeTemplate() {
  std::vector<float> numbers;
  for (int i = 0; i < 36; ++i) numbers.push_back(0.8f * std::sin(1.0f + 2.3f * float(i)));
  return torch::tensor(numbers).reshape({12, 3});
}

/// Twenty points in triangles of SomeTemplate, the same for all codes or, if num_codes > 0, others for each.
inline deform::SurfacePoints SomePoints(int64_t num_codes) {
  torch::manual_seed(11);
  const int64_t count = std::max<int64_t>(num_codes, 1) * 20;
  const torch::Tensor corners = torch::randint(0, 12, {count, 3}, torch::kInt64),
                      weights = torch::softmax(torch::randn({count, 3}), 1);
  const torch::Tensor positions =
      (SomeTemplate().index_select(0, corners.reshape({-1})).reshape({count, 3, 3}) * weights.unsqueeze(2)).sum(1);
  const auto shaped = [&](const torch::Tensor& numbers) {
    return num_codes > 0 ? numbers.reshape({num_codes, 20, 3}) : numbers;
  };
  return {shaped(corners), shaped(weights), shaped(positions)};
}

/// Trains a network and codes on eight random faces; returns what is left of the faces' root mean square displacement
/// from the template.
inline double ErrorAfterOverfitting(const deform::DeformOptions& options, int steps, double rate) {
  const auto network = deform::MakeDeformNetwork(options, SomeTemplate(), {});
  const torch::Tensor displacements = 0.1 * torch::randn({8, 12, 3}), truth = SomeTemplate() + displacements;
  torch::Tensor codes = (0.1 * torch::randn({8, options.latent})).requires_grad_();
  std::vector<torch::Tensor> trained = network->parameters();
  trained.push_back(codes);
  torch::optim::Adam optimiser(trained, torch::optim::AdamOptions(rate));
  double error = 0;
  for (int step = 0; step < steps; ++step) {
    optimiser.zero_grad();
    const torch::Tensor loss = (network->DeformVertices(codes) - truth).square().mean();
    loss.backward();
    optimiser.step();
    error = loss.item<double>();
  }
  return std::sqrt(error / displacements.square().mean().item<double>());
}

}  // namespace daumier::testing
