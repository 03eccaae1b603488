#include "losses/opening_loss.h"

#include "core/error.h"
#include "tensor/shape.h"

#include <ATen/Functions.h>

#include <algorithm>

namespace daumier::losses {

LandmarkPairs EyelidPairs() {
  return {{37, 41}, {38, 40}, {43, 47}, {44, 46}};
}

LandmarkPairs LipPairs() {
  return {{61, 67}, {62, 66}, {63, 65}};
}

torch::Tensor OpeningLoss(const torch::Tensor& predicted, const torch::Tensor& target, const LandmarkPairs& pairs) {
  constexpr double kRounding = 1e-2;
  tensor::CheckShape(predicted, {tensor::kAny, tensor::kAny, 2}, "predicted");
  tensor::CheckShape(target, predicted.sizes(), "target");
  DAUMIER_CHECK(!pairs.empty(), "an opening needs a pair of landmarks");
  std::vector<int64_t> upper, lower;
  for (const auto& [a, b] : pairs) {
    DAUMIER_CHECK(std::min(a, b) >= 0 && std::max(a, b) < predicted.size(1),
                  "the pair of landmarks {} and {} is not among {}", a, b, predicted.size(1));
    upper.push_back(a);
    lower.push_back(b);
  }
  const auto index = [&](const std::vector<int64_t>& of) {
    return at::tensor(of, at::TensorOptions().dtype(at::kLong).device(predicted.device()));
  };
  const torch::Tensor difference = predicted - target, above = index(upper), below = index(lower);
  const torch::Tensor change = difference.index_select(1, above) - difference.index_select(1, below);
  return ((change.square().sum(2) + kRounding * kRounding).sqrt() - kRounding).mean();
}

}  // namespace daumier::losses
