#include "systems/portrait/train/portrait_refinement.h"

#include "models/coefficient_map.h"
#include "tensor/torch_version.h"

#include <torch/autograd.h>

#include <cmath>

namespace daumier::portrait {
namespace {

/// What is a usual change of each coefficient, (1, 239).
torch::Tensor UsualChanges(const torch::Tensor& like) {
  constexpr double kIdentity = 1, kExpression = 0.5, kAlbedo = 1, kLight = 0.3, kAngle = 0.15, kShift = 1, kDepth = 4;
  torch::Tensor changes = torch::full({1, faces::kNumCoefficients}, kIdentity, like.options());
  const auto set = [&](int first, int count, double value) { changes.narrow(1, first, count).fill_(value); };
  set(faces::kExpressionSlot.first, faces::kExpressionSlot.count, kExpression);
  set(faces::kAlbedoSlot.first, faces::kAlbedoSlot.count, kAlbedo);
  set(faces::kLightSlot.first, faces::kLightSlot.count, kLight);
  set(faces::kPoseSlot.first, 3, kAngle);
  set(faces::kPoseSlot.first + 3, 2, kShift);
  set(faces::kPoseSlot.first + 5, 1, kDepth);
  return changes;
}

}  // namespace

torch::Tensor RefinePortrait(const PortraitLoss& loss, const torch::Tensor& guess, const train::Batch& batch,
                             faces::ExpressionWeights weights, const RefinementOptions& options) {
  constexpr double kBeta1 = 0.9, kBeta2 = 0.99, kLeastRate = 0.1, kRounding = 1e-12;
  const torch::Tensor changes = UsualChanges(guess);
  torch::Tensor at = guess.detach().clone(), best = at.clone(), mean = torch::zeros_like(at), square = mean.clone();
  double least = 0;
  for (int step = 0; step <= options.steps; ++step) {
    at.set_requires_grad(true);
    const torch::Tensor total = loss(at, batch).total;
    const double value = total.item<double>();
    if (step == 0 || value < least) {
      least = value;
      best = at.detach().clone();
    }
    if (step == options.steps) break;
    const torch::Tensor gradient = torch::autograd::grad({total}, {at})[0] * changes;
    const at::NoGradGuard no_grad;
    mean = kBeta1 * mean + (1 - kBeta1) * gradient;
    square = kBeta2 * square + (1 - kBeta2) * gradient.square();
    const double t = step + 1, share = double(step) / options.steps,
                 rate = options.rate * (1 - (1 - kLeastRate) * share);
    const torch::Tensor move =
        (mean / (1 - std::pow(kBeta1, t))) / ((square / (1 - std::pow(kBeta2, t))).sqrt() + kRounding);
    at = models::ClampedExpressions(at.detach() - rate * changes * move, weights).clone();
  }
  return best;
}

}  // namespace daumier::portrait
