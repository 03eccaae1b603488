#pragma once
#include <torch/types.h>

namespace daumier::losses {

/// Weights of the regulariser of coefficients [Pan et al. 2024, eq. 6].
struct CoefficientPriorWeights {
  double identity = 1.2, expression = 1.0, albedo = 1.2e-3;
};

/// Regulariser of coefficients [Pan et al. 2024, eq. 6]: w_id |a_id|^2 + w_exp |a_exp|^2 + w_tex |a_tex|^2, sums over
/// the coefficients, mean over the batch. identity (B, S), expression (B, E), albedo (B, A). Zero iff all are the
/// mean face's. @throws daumier::Error if the batches differ.
torch::Tensor CoefficientPriorLoss(const torch::Tensor& identity, const torch::Tensor& expression,
                                   const torch::Tensor& albedo, const CoefficientPriorWeights& weights = {});

}  // namespace daumier::losses
