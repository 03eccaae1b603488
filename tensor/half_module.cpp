#include "tensor/half_module.h"

#include "core/error.h"
#include "core/half.h"
#include "tensor/torch_version.h"

#include <cmath>

namespace daumier::tensor {

NamedTensors HalvedState(const NamedTensors& state) {
  const at::NoGradGuard no_grad;
  NamedTensors halved;
  for (const auto& [name, tensor] : state) {
    const bool is_halved = tensor.scalar_type() == torch::kFloat32 && tensor.dim() >= 2 && tensor.numel() > 0;
    if (is_halved) {
      const float largest = tensor.abs().max().item<float>();
      DAUMIER_CHECK(std::isfinite(largest), "the weights '{}' are not all finite numbers. Train again", name);
      DAUMIER_CHECK(largest <= kLargestHalf,
                    "the weights '{}' have values up to {:g}, which float16 does not hold (expected at most {:g}). "
                    "Train again with optimiser.weight_decay or optimiser.clip_norm",
                    name, largest, kLargestHalf);
    }
    halved[name] = is_halved ? tensor.to(torch::kFloat16) : tensor;
  }
  return halved;
}

std::string SaveHalfModule(const std::filesystem::path& file, const torch::nn::Module& module) {
  return SaveTensors(file, HalvedState(StateOf(module)));
}

void LoadHalfModule(const std::filesystem::path& file, torch::nn::Module& module) {
  NamedTensors state = LoadTensors(file);
  for (auto& [name, tensor] : state)
    if (tensor.scalar_type() == torch::kFloat16) tensor = tensor.to(torch::kFloat32);
  LoadState(module, state, file.string());
}

}  // namespace daumier::tensor
