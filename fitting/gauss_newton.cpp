#include "fitting/gauss_newton.h"

#include "core/error.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace daumier::fitting {
namespace {

constexpr double kLeastDamping = 1e-9, kFirstDamping = 1e-3, kDampingFactor = 10;
constexpr int kMostTrials = 8;
constexpr double kLeastFall = 1e-6, kLeastGain = 0.5;

/// J^T J; half of it by symmetry.
Eigen::MatrixXd NormalMatrix(const Eigen::MatrixXd& derivative) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(derivative.cols(), derivative.cols());
  matrix.selfadjointView<Eigen::Lower>().rankUpdate(derivative.transpose());
  return matrix.selfadjointView<Eigen::Lower>();
}

}  // namespace

Minimum Minimise(const Residuals& residuals, const Eigen::VectorXd& start, int steps) {
  Minimum minimum{start, {}};
  Eigen::VectorXd here = residuals.at(start);
  DAUMIER_CHECK(here.allFinite(), "the energy where a fit starts is not finite");
  minimum.energies = {here.squaredNorm()};
  Eigen::MatrixXd derivative, normal;
  bool is_fresh = false;
  double damping = kLeastDamping;
  for (int step = 0; step < steps;) {
    if (derivative.size() == 0) {
      derivative = residuals.derivative(minimum.x);
      normal = NormalMatrix(derivative);
      is_fresh = true;
    }
    const Eigen::VectorXd gradient = derivative.transpose() * here;
    const double before = minimum.energies.back(), scale = std::max(1e-300, normal.diagonal().mean());
    bool taken = false, good = false;
    for (int trial = 0; trial < kMostTrials && !taken; ++trial) {
      Eigen::MatrixXd damped = normal;
      damped.diagonal().array() += damping * scale;
      const Eigen::VectorXd move = damped.ldlt().solve(-gradient);
      if (move.allFinite()) {
        const double predicted = before - (here + derivative * move).squaredNorm();
        const Eigen::VectorXd moved = minimum.x + move;
        const Eigen::VectorXd there = residuals.at(moved);
        if (there.allFinite() && there.squaredNorm() < before) {
          taken = true;
          good = before - there.squaredNorm() >= kLeastGain * predicted;
          minimum.x = moved;
          here = there;
          minimum.energies.push_back(here.squaredNorm());
        } else if (predicted < kLeastFall * before) {
          break;
        }
      }
      if (!taken && !is_fresh) break;  // A newer derivative may do better than damping.
      if (!taken) damping = std::max(kFirstDamping, kDampingFactor * damping);
    }
    if (!taken && is_fresh) break;
    step += taken ? 1 : 0;
    if (taken && before - minimum.energies.back() < kLeastFall * before) break;
    if (taken) damping = std::max(kLeastDamping, damping / kDampingFactor);
    if (!residuals.is_linear && !(taken && good)) derivative.resize(0, 0);
    is_fresh = residuals.is_linear;
  }
  return minimum;
}

}  // namespace daumier::fitting
