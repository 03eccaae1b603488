#pragma once
#include <Eigen/Core>

#include <functional>
#include <vector>

namespace daumier::fitting {

/// An energy that is to be lowered,
///   E(x) = |r(x)|^2 + sum_i w_i (x_i - m_i)^2,
/// with the residuals' derivative.
struct SquaredEnergy {
  std::function<Eigen::VectorXd(const Eigen::VectorXd&)> residuals;   ///< r, R numbers.
  std::function<Eigen::MatrixXd(const Eigen::VectorXd&)> derivative;  ///< R x N
  Eigen::VectorXd prior_weights, prior_mean;                          ///< w and m, N; w_i >= 0.
  bool is_linear = false;    ///< The derivative is the same everywhere: it is computed once.
  double least_fall = 1e-6;  ///< A minimum is found where a step lowers E by less than this share of it.
};

struct Minimum {
  Eigen::VectorXd x;
  std::vector<double> energies;  ///< At the start and after each step; never rises.
};

/// Damped Gauss-Newton steps [Levenberg 1944; Marquardt 1963] from `start`. The derivative is computed again only
/// where a step lowers E by less than half of what it predicts; until then each step corrects it by what the
/// residuals did, J += (r(x + d) - r(x) - J d) d^T / |d|^2 [Broyden 1965]. A step that does not lower E is not taken.
/// Ends after `steps` steps, or where E falls by less than least_fall of itself. @throws Error if a size disagrees or
/// E is not finite at the start.
Minimum Minimise(const SquaredEnergy& energy, const Eigen::VectorXd& start, int steps);

}  // namespace daumier::fitting
