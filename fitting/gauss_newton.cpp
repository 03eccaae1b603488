#include "fitting/gauss_newton.h"

#include "core/error.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace daumier::fitting {
namespace {

constexpr double kLeastDamping = 1e-9, kFirstDamping = 1e-3, kDampingFactor = 10;
constexpr int kMostTrials = 8;
constexpr double kLeastGain = 0.5;

/// J^T J; half of it by symmetry.
Eigen::MatrixXd NormalMatrix(const Eigen::MatrixXd& derivative) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(derivative.cols(), derivative.cols());
  matrix.selfadjointView<Eigen::Lower>().rankUpdate(derivative.transpose());
  return matrix.selfadjointView<Eigen::Lower>();
}

/// Broyden's correction of a derivative and of J^T J after a move, of which it predicted `miss` too little.
void Correct(const Eigen::VectorXd& move, const Eigen::VectorXd& miss, Eigen::MatrixXd& derivative,
             Eigen::MatrixXd& normal) {
  const Eigen::VectorXd along = move / move.squaredNorm(), by_miss = derivative.transpose() * miss;
  normal += by_miss * along.transpose() + along * by_miss.transpose() + miss.squaredNorm() * along * along.transpose();
  derivative += miss * along.transpose();
}

}  // namespace

Minimum Minimise(const SquaredEnergy& energy, const Eigen::VectorXd& start, int steps) {
  DAUMIER_CHECK(energy.prior_weights.size() == start.size() && energy.prior_mean.size() == start.size(),
                "a prior of {} weights and {} means of {} unknowns", energy.prior_weights.size(),
                energy.prior_mean.size(), start.size());
  const auto prior_of = [&](const Eigen::VectorXd& x) {
    return energy.prior_weights.dot((x - energy.prior_mean).cwiseAbs2());
  };
  Minimum minimum{start, {}};
  Eigen::VectorXd here = energy.residuals(start);
  DAUMIER_CHECK(here.allFinite() && start.allFinite(), "the energy where a fit starts is not finite");
  minimum.energies = {here.squaredNorm() + prior_of(start)};
  Eigen::MatrixXd derivative, normal;
  bool is_fresh = false;
  double damping = kLeastDamping;
  for (int step = 0; step < steps;) {
    if (derivative.size() == 0) {
      derivative = energy.derivative(minimum.x);
      normal = NormalMatrix(derivative);
      normal.diagonal() += energy.prior_weights;
      is_fresh = true;
    }
    const Eigen::VectorXd gradient =
        derivative.transpose() * here + energy.prior_weights.cwiseProduct(minimum.x - energy.prior_mean);
    const double before = minimum.energies.back(), scale = std::max(1e-300, normal.diagonal().mean());
    bool taken = false, good = false;
    for (int trial = 0; trial < kMostTrials && !taken; ++trial) {
      Eigen::MatrixXd damped = normal;
      damped.diagonal().array() += damping * scale;
      const Eigen::VectorXd move = damped.llt().solve(-gradient);
      if (move.allFinite()) {
        const Eigen::VectorXd moved = minimum.x + move;
        const Eigen::VectorXd expected = here + derivative * move;
        const double predicted = before - expected.squaredNorm() - prior_of(moved);
        const Eigen::VectorXd there = energy.residuals(moved);
        const double after = there.squaredNorm() + prior_of(moved);
        if (there.allFinite() && after < before) {
          taken = true;
          good = before - after >= kLeastGain * predicted;
          if (!energy.is_linear && good) Correct(move, there - expected, derivative, normal);
          minimum.x = moved;
          here = there;
          minimum.energies.push_back(after);
        } else if (predicted < energy.least_fall * before) {
          break;
        }
      }
      if (!taken && !is_fresh) break;  // A newer derivative may do better than damping.
      if (!taken) damping = std::max(kFirstDamping, kDampingFactor * damping);
    }
    if (!taken && is_fresh) break;
    step += taken ? 1 : 0;
    if (taken && before - minimum.energies.back() < energy.least_fall * before) break;
    if (taken) damping = std::max(kLeastDamping, damping / kDampingFactor);
    if (!energy.is_linear && !(taken && good)) derivative.resize(0, 0);
    is_fresh = energy.is_linear;
  }
  return minimum;
}

}  // namespace daumier::fitting
