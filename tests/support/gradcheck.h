#pragma once
#include <torch/utils.h>

#include <algorithm>
#include <functional>

namespace daumier::testing {

/// Largest difference between autograd's gradient of a scalar function and central differences, in float64, over all
/// entries of x.
inline double MaxGradientError(const std::function<torch::Tensor(const torch::Tensor&)>& function,
                               const torch::Tensor& x, double step = 1e-5) {
  const auto at = x.detach().to(torch::kFloat64).clone().set_requires_grad(true);
  function(at).backward();
  const auto analytic = at.grad().flatten();
  torch::NoGradGuard no_grad;
  const auto shifted = [&](int64_t entry, double by) {
    auto moved = at.detach().flatten().clone();
    moved[entry] += by;
    return function(moved.view_as(at)).item<double>();
  };
  double worst = 0;
  for (int64_t i = 0; i < analytic.numel(); ++i) {
    const double numeric = (shifted(i, step) - shifted(i, -step)) / (2 * step);
    worst = std::max(worst, std::abs(numeric - analytic[i].item<double>()));
  }
  return worst;
}

}  // namespace daumier::testing
