#pragma once
#include <Eigen/Core>

#include <functional>
#include <vector>

namespace daumier::fitting {

/// Where an energy E(x) = |r(x)|^2 is to be lowered, with the residuals' derivative.
struct Residuals {
  std::function<Eigen::VectorXd(const Eigen::VectorXd&)> at;          ///< r, R numbers.
  std::function<Eigen::MatrixXd(const Eigen::VectorXd&)> derivative;  ///< R x N
  bool is_linear = false;  ///< The derivative is the same everywhere: it is computed once.
};

struct Minimum {
  Eigen::VectorXd x;
  std::vector<double> energies;  ///< At the start and after each step; never rises.
};

/// Damped Gauss-Newton steps [Levenberg 1944; Marquardt 1963] from `start`. The derivative is kept while a step lowers E
/// by at least half of what it predicts. A step that does not lower E is not taken. Ends after `steps` steps, or where
/// E falls by less than 1e-6 of itself. @throws Error if E is not finite at the start.
Minimum Minimise(const Residuals& residuals, const Eigen::VectorXd& start, int steps);

}  // namespace daumier::fitting
