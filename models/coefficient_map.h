#pragma once
#include "faces/morphable_model.h"

#include <torch/types.h>

namespace daumier::models {

/// How outputs of a network become the coefficients of a portrait. An output of about 1 is a large but usual value of
/// every coefficient, and outputs of 0 are the mean face: expression and albedo of the mean, in the usual pose.
struct CoefficientMap {
  faces::ExpressionWeights expression_weights = faces::ExpressionWeights::kUnit;
  double usual_depth = -45;  ///< cm, t_z at output 0.
};

/// (B, 239) outputs y -> (B, 239) coefficients: identity and albedo y; expression of kStandardNormal y, of kUnit
///   f(y) = (s(g y - c) - s(-c)) / (1 - s(-c)), s the logistic function, g = 4, c = 4,
/// which is 0 at 0, rises everywhere and lies between -0.0183 and 1; light 0.3 y; pitch, yaw and roll 0.3 y (radians);
/// t_x and t_y 2 y (cm); t_z usual_depth + 10 y (cm).
/// @throws daumier::Error if the shape differs.
torch::Tensor CoefficientsOf(const torch::Tensor& outputs, const CoefficientMap& map);

/// The same with expression weights of kUnit cut off at 0: what a prediction holds.
torch::Tensor ClampedExpressions(const torch::Tensor& coefficients, faces::ExpressionWeights weights);

/// The numbers of a slot, (B, count), of coefficients (B, 239).
torch::Tensor Slot(const torch::Tensor& coefficients, const faces::CoefficientSlot& slot);

}  // namespace daumier::models
