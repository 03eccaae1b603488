#include "rig/bounded_least_squares.h"

#include "core/error.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <vector>

namespace daumier::rig {
namespace {

constexpr double kTolerance = 1e-10;   // Of gradients of columns of unit length, as a share of the greatest at 0.
constexpr double kLeastPivot = 1e-11;  // Of the factor: below it columns count as dependent.
constexpr double kLeastLength = 1e-6;  // Of the longest column: shorter ones count as 0.
constexpr int kLargestSteps = 100;     // A variable.

enum class Place { kLower, kFree, kUpper };

/// The problem with columns of unit length, and where each variable is.
class ActiveSets {
 public:
  ActiveSets(const Eigen::MatrixXd& gram, const Eigen::VectorXd& right, const Eigen::VectorXd& most)
      : lengths_(gram.diagonal().cwiseMax(0.0).cwiseSqrt()),
        values_(Eigen::VectorXd::Zero(right.size())),
        places_(size_t(right.size()), Place::kLower),
        is_skipped_(size_t(right.size()), false) {
    const double least_length = kLeastLength * lengths_.maxCoeff();
    for (double& length : lengths_)
      if (length < least_length) length = 0;
    const Eigen::VectorXd scales = lengths_.unaryExpr([](double length) { return length > 0 ? 1 / length : 0.0; });
    gram_ = scales.asDiagonal() * gram * scales.asDiagonal();
    right_ = scales.asDiagonal() * right;
    most_ = most;
    for (Eigen::Index i = 0; i < most.size(); ++i) most_[i] = lengths_[i] > 0 ? most[i] * lengths_[i] : 0;
    least_gradient_ = kTolerance * right_.cwiseAbs().maxCoeff();
  }

  Eigen::VectorXd Solve() {
    const int64_t most_steps = kLargestSteps * right_.size();
    for (int64_t step = 0; step < most_steps; ++step) {
      const Eigen::Index entering = Entering();
      if (entering < 0) break;
      Enter(entering);
    }
    Eigen::VectorXd result = values_;
    for (Eigen::Index i = 0; i < result.size(); ++i) result[i] = lengths_[i] > 0 ? result[i] / lengths_[i] : 0;
    return result;
  }

 private:
  /// The variable at a bound whose release lowers the error most; -1: none does.
  Eigen::Index Entering() const {
    const Eigen::VectorXd gradient = right_ - gram_ * values_;
    Eigen::Index best = -1;
    double greatest = least_gradient_;
    for (Eigen::Index i = 0; i < gradient.size(); ++i) {
      const Place place = places_[size_t(i)];
      if (place == Place::kFree || is_skipped_[size_t(i)] || most_[i] <= 0) continue;
      const double gain = place == Place::kLower ? gradient[i] : -gradient[i];
      if (gain > greatest) {
        greatest = gain;
        best = i;
      }
    }
    return best;
  }

  /// Frees a variable, then moves to the least error of the free ones, on the way fixing those that reach a bound.
  void Enter(Eigen::Index entering) {
    const Place from = places_[size_t(entering)];
    places_[size_t(entering)] = Place::kFree;
    for (bool is_first = true;; is_first = false) {
      std::vector<Eigen::Index> free;
      for (Eigen::Index i = 0; i < values_.size(); ++i)
        if (places_[size_t(i)] == Place::kFree) free.push_back(i);
      if (free.empty()) break;
      const Eigen::LDLT<Eigen::MatrixXd> factor(gram_(free, free).eval());
      const Eigen::VectorXd moves = factor.solve((right_ - gram_ * values_)(free));
      if (is_first) {
        const auto at = std::ranges::find(free, entering) - free.begin();
        const bool is_inward = from == Place::kLower ? moves[at] > 0 : moves[at] < 0;
        if (factor.vectorD().minCoeff() < kLeastPivot || !moves.allFinite() || !is_inward) {
          places_[size_t(entering)] = from;
          is_skipped_[size_t(entering)] = true;
          return;
        }
      }
      if (MoveWithin(free, moves)) break;
    }
    is_skipped_.assign(is_skipped_.size(), false);
  }

  /// As far along `moves` as bounds allow. Whether all of it.
  bool MoveWithin(const std::vector<Eigen::Index>& free, const Eigen::VectorXd& moves) {
    double share = 1;
    Eigen::Index blocking = -1;
    for (size_t k = 0; k < free.size(); ++k) {
      const double move = moves[Eigen::Index(k)], value = values_[free[k]];
      const double room = move < 0 ? -value : most_[free[k]] - value;
      if (std::abs(move) <= std::abs(room) || share * std::abs(move) <= std::abs(room)) continue;
      share = std::abs(room / move);
      blocking = free[k];
    }
    for (size_t k = 0; k < free.size(); ++k) values_[free[k]] += share * moves[Eigen::Index(k)];
    if (blocking < 0) return true;
    const bool is_lower = values_[blocking] < 0.5 * most_[blocking];
    places_[size_t(blocking)] = is_lower ? Place::kLower : Place::kUpper;
    values_[blocking] = is_lower ? 0 : most_[blocking];
    return false;
  }

  Eigen::VectorXd lengths_, values_, right_, most_;
  Eigen::MatrixXd gram_;
  std::vector<Place> places_;
  std::vector<bool> is_skipped_;
  double least_gradient_ = 0;
};

}  // namespace

Eigen::VectorXd BoundedLeastSquares(const Eigen::MatrixXd& gram, const Eigen::VectorXd& right,
                                    const Eigen::VectorXd& most) {
  const Eigen::Index n = right.size();
  DAUMIER_CHECK(gram.rows() == n && gram.cols() == n && most.size() == n,
                "least squares: the matrix is {} x {}, the right side has {} numbers, the bounds {}", gram.rows(),
                gram.cols(), n, most.size());
  DAUMIER_CHECK(gram.allFinite() && right.allFinite(), "least squares: a number is not finite");
  DAUMIER_CHECK((most.array() >= 0).all(), "least squares: an upper bound is negative");
  if (n == 0) return {};
  return ActiveSets(gram, right, most).Solve();
}

}  // namespace daumier::rig
