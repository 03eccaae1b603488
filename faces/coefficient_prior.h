#pragma once
#include "faces/bilinear_model.h"

namespace daumier::faces {

/// What is known of u and v before anything is seen: independent normal distributions.
struct CoefficientPrior {
  Eigen::VectorXf u_mean, u_deviation;  ///< Ku
  Eigen::VectorXf v_mean, v_deviation;  ///< Kv
};

/// Means and standard deviations over the fitted identities and expressions; no deviation is less than 1e-3 of the
/// length of its mean vector.
CoefficientPrior PriorOf(const BilinearModel& model);

/// A Gaussian prior centred on given u and v, with standard deviations scaled by `share`.
/// @throws Error if u or v has the wrong length or the share is not positive.
CoefficientPrior CentredPrior(const CoefficientPrior& prior, const Eigen::VectorXf& u, const Eigen::VectorXf& v,
                              double share);

}  // namespace daumier::faces
