#include "models/harmonic_light.h"

#include "tensor/shape.h"

#include <ATen/Functions.h>

namespace daumier::models {

torch::Tensor HarmonicShade(const torch::Tensor& normals, const torch::Tensor& light) {
  constexpr double kBand0 = 0.886227, kBand1 = 1.772454, kBand2 = 2.427032, kBand2z = 0.700624, kBand2xy = 1.213516;
  tensor::CheckShape(normals, {tensor::kAny, tensor::kAny, 3}, "normals");
  tensor::CheckShape(light, {normals.size(0), 9}, "light");
  const torch::Tensor x = normals.select(2, 0), y = normals.select(2, 1), z = normals.select(2, 2);
  const auto number = [&](int64_t k) { return light.narrow(1, k, 1); };
  return (number(0) + kAmbientLight) * kBand0 - kBand1 * number(1) * y + kBand1 * number(2) * z -
         kBand1 * number(3) * x + kBand2 * number(4) * x * y - kBand2 * number(5) * y * z +
         kBand2z * number(6) * (3 * z * z - 1) - kBand2 * number(7) * x * z + kBand2xy * number(8) * (x * x - y * y);
}

}  // namespace daumier::models
