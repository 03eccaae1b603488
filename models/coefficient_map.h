#pragma once
#include "faces/morphable_model.h"

#include <torch/types.h>

namespace daumier::models {

/// How outputs of a network become the coefficients of a portrait, (B, 239) outputs y -> (B, 239). An output of about 1 is
/// a large but usual value of every coefficient, and outputs of 0 are the mean face in its usual pose (6):
///   identity and albedo y; expression of kStandardNormal y, of kUnit
///     f(y) = (s(g y - c) - s(-c)) / (1 - s(-c)), s the logistic function, g = 4, c = 4,
///   which is 0 at 0, rises everywhere and lies between -0.0183 and 1; light 0.3 y; pose usual_pose + (0.3, 0.3, 0.3, 2, 2,
///   10) y, radians and cm.
/// @throws daumier::Error if a shape differs.
torch::Tensor CoefficientsOf(const torch::Tensor& outputs, faces::ExpressionWeights expression_weights,
                             const torch::Tensor& usual_pose);

/// The same with expression weights of kUnit cut off at 0: what a prediction holds.
torch::Tensor ClampedExpressions(const torch::Tensor& coefficients, faces::ExpressionWeights weights);

/// The numbers of a slot, (B, count), of coefficients (B, 239).
torch::Tensor Slot(const torch::Tensor& coefficients, const faces::CoefficientSlot& slot);

}  // namespace daumier::models
