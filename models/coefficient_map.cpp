#include "models/coefficient_map.h"

#include "tensor/shape.h"

#include <ATen/Functions.h>

#include <cmath>

namespace daumier::models {
namespace {

constexpr double kGain = 4, kOffset = 4;
constexpr double kLightScale = 0.3, kAngleScale = 0.3, kShiftScale = 2, kDepthScale = 10;

torch::Tensor UnitWeights(const torch::Tensor& outputs) {
  const double zero = 1 / (1 + std::exp(kOffset));
  return (at::sigmoid(kGain * outputs - kOffset) - zero) * (1 / (1 - zero));
}

}  // namespace

torch::Tensor Slot(const torch::Tensor& coefficients, const faces::CoefficientSlot& slot) {
  return coefficients.narrow(1, slot.first, slot.count);
}

torch::Tensor CoefficientsOf(const torch::Tensor& outputs, faces::ExpressionWeights expression_weights,
                             const torch::Tensor& usual_pose) {
  tensor::CheckShape(usual_pose, {faces::kPoseSlot.count}, "usual_pose");
  tensor::CheckShape(outputs, {tensor::kAny, faces::kNumCoefficients}, "outputs");
  const torch::Tensor expression = Slot(outputs, faces::kExpressionSlot), pose = Slot(outputs, faces::kPoseSlot);
  return at::cat({Slot(outputs, faces::kIdentitySlot),
                  expression_weights == faces::ExpressionWeights::kUnit ? UnitWeights(expression) : expression,
                  Slot(outputs, faces::kAlbedoSlot), kLightScale * Slot(outputs, faces::kLightSlot),
                  kAngleScale * pose.narrow(1, 0, 3) + usual_pose.narrow(0, 0, 3),
                  kShiftScale * pose.narrow(1, 3, 2) + usual_pose.narrow(0, 3, 2),
                  kDepthScale * pose.narrow(1, 5, 1) + usual_pose.narrow(0, 5, 1)},
                 1);
}

torch::Tensor ClampedExpressions(const torch::Tensor& coefficients, faces::ExpressionWeights weights) {
  if (weights != faces::ExpressionWeights::kUnit) return coefficients;
  const int64_t begin = faces::kExpressionSlot.first, end = begin + faces::kExpressionSlot.count;
  return at::cat(
      {coefficients.slice(1, 0, begin), coefficients.slice(1, begin, end).clamp(0, 1), coefficients.slice(1, end)}, 1);
}

}  // namespace daumier::models
