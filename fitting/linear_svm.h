#pragma once
#include <Eigen/Core>

#include <vector>

namespace daumier::fitting {

/// A plane between two kinds of points: x is of the second kind where normal . x + offset > 0.
struct SeparatingPlane {
  Eigen::VectorXd normal;  ///< M
  double offset = 0;
};

/// Linear support vector machine [Fan et al. 2008, L2-regularised squared hinge loss]: the (w, b) of least
///   1/2 |w|^2 + 1/2 b^2 + cost sum_i s_i max(0, 1 - y_i (w . x_i + b))^2,
/// y_i = 1 where is_second, else -1; s_i = N / (2 N_kind), so that both kinds weigh the same. By liblinear's Newton
/// method, a function of its arguments alone.
/// points: N x M, a row a point. @throws Error if sizes differ, a number is not finite, cost is not positive or a kind
/// has no point.
SeparatingPlane TrainLinearSvm(const Eigen::MatrixXd& points, const std::vector<bool>& is_second, double cost);

/// The share of points on their side of a plane, each kind counting half.
double BalancedAccuracy(const SeparatingPlane& plane, const Eigen::MatrixXd& points,
                        const std::vector<bool>& is_second);

/// Of 1e-4, 1e-3 ... 1 the cost of the greatest balanced accuracy in cross-validation over four parts (the i-th point of
/// each kind is held out in part i mod 4), of equals the least. @throws Error as TrainLinearSvm, also of a part: with
/// fewer than two points of a kind.
double BestSvmCost(const Eigen::MatrixXd& points, const std::vector<bool>& is_second);

}  // namespace daumier::fitting
