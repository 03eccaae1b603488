#include "faces/coefficient_prior.h"

#include "core/error.h"

namespace daumier::faces {
namespace {

/// Below this share of the factors' size a standard deviation means that a factor is constant.
constexpr float kLeastDeviation = 1e-3f;

Eigen::VectorXf DeviationOf(const Eigen::MatrixXf& factors, const Eigen::VectorXf& mean) {
  const Eigen::MatrixXf centred = factors.rowwise() - mean.transpose();
  return (centred.colwise().squaredNorm() / float(factors.rows())).cwiseSqrt().cwiseMax(kLeastDeviation * mean.norm());
}

}  // namespace

CoefficientPrior PriorOf(const BilinearModel& model) {
  CoefficientPrior prior;
  prior.u_mean = model.identity_factors.colwise().mean();
  prior.v_mean = model.expression_factors.colwise().mean();
  prior.u_deviation = DeviationOf(model.identity_factors, prior.u_mean);
  prior.v_deviation = DeviationOf(model.expression_factors, prior.v_mean);
  return prior;
}

CoefficientPrior CentredPrior(const CoefficientPrior& prior, const Eigen::VectorXf& u, const Eigen::VectorXf& v,
                              double share) {
  DAUMIER_CHECK(u.size() == prior.u_mean.size() && v.size() == prior.v_mean.size(),
                "u and v have {} and {} numbers, their prior {} and {}", u.size(), v.size(), prior.u_mean.size(),
                prior.v_mean.size());
  DAUMIER_CHECK(share > 0, "a prior with {} times its deviations, expected a positive factor", share);
  return {.u_mean = u,
          .u_deviation = float(share) * prior.u_deviation,
          .v_mean = v,
          .v_deviation = float(share) * prior.v_deviation};
}

}  // namespace daumier::faces
