#include "fitting/quadratic_surface.h"

#include "core/error.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace daumier::fitting {
namespace {

constexpr double kCorner = 0.7;
constexpr int kDescentSteps = 200, kRootSteps = 60;

}  // namespace

Eigen::MatrixXd CompositeDesign(int num_variables) {
  const Eigen::Index num_corners = Eigen::Index(1) << num_variables;
  Eigen::MatrixXd design = Eigen::MatrixXd::Zero(num_corners + 2 * num_variables + 1, num_variables);
  for (Eigen::Index corner = 0; corner < num_corners; ++corner)
    for (int axis = 0; axis < num_variables; ++axis) design(corner, axis) = corner >> axis & 1 ? kCorner : -kCorner;
  for (int axis = 0; axis < num_variables; ++axis) {
    design(num_corners + 2 * axis, axis) = -1.0;
    design(num_corners + 2 * axis + 1, axis) = 1.0;
  }
  return design;
}

Eigen::MatrixXd SpreadDesign(int num_variables, int first, int count) {
  double root = 1.5;
  for (int i = 0; i < kRootSteps; ++i) root = std::pow(1.0 + root, 1.0 / (num_variables + 1));
  Eigen::MatrixXd design(count, num_variables);
  for (int axis = 0; axis < num_variables; ++axis) {
    const double step = std::pow(root, -(axis + 1));
    for (int i = 0; i < count; ++i) design(i, axis) = 2.0 * std::fmod(0.5 + step * (first + i + 1), 1.0) - 1.0;
  }
  return design;
}

double QuadraticSurface::At(const Eigen::VectorXd& x) const {
  return value + gradient.dot(x) + 0.5 * x.dot(hessian * x);
}

Eigen::VectorXd QuadraticSurface::LowestInBox() const {
  Eigen::VectorXd lowest = Eigen::VectorXd::Zero(gradient.size());
  const Eigen::MatrixXd places = CompositeDesign(int(gradient.size()));
  for (Eigen::Index i = 0; i < places.rows(); ++i)
    if (At(places.row(i).transpose()) < At(lowest)) lowest = places.row(i).transpose();
  const double step = 1.0 / std::max(1e-12, hessian.norm());  // At most 1 / the largest eigenvalue.
  for (int i = 0; i < kDescentSteps; ++i)
    lowest = (lowest - step * (gradient + hessian * lowest)).cwiseMax(-1.0).cwiseMin(1.0);
  return lowest;
}

QuadraticSurface FitQuadraticSurface(const Eigen::MatrixXd& places, const Eigen::VectorXd& values,
                                     const Eigen::VectorXd& weights) {
  const Eigen::Index n = places.cols(), num_terms = (n + 1) * (n + 2) / 2;
  DAUMIER_CHECK(
      places.rows() == values.size() && places.rows() >= num_terms && places.allFinite() && values.allFinite(),
      "{} values at {} places do not determine a quadratic surface of {} variables (expected {} finite ones)",
      values.size(), places.rows(), n, num_terms);
  DAUMIER_CHECK(
      weights.size() == 0 || (weights.size() == values.size() && weights.allFinite() && weights.minCoeff() >= 0.0),
      "{} weights of {} values (expected one each, not negative)", weights.size(), values.size());
  Eigen::MatrixXd terms(places.rows(), num_terms);
  terms.col(0).setOnes();
  terms.middleCols(1, n) = places;
  for (Eigen::Index i = 0, term = 1 + n; i < n; ++i)
    for (Eigen::Index j = i; j < n; ++j, ++term)
      terms.col(term) = (i == j ? 0.5 : 1.0) * places.col(i).cwiseProduct(places.col(j));
  Eigen::VectorXd right = values;
  if (weights.size() > 0) {
    const Eigen::VectorXd roots = weights.cwiseSqrt();
    terms = roots.asDiagonal() * terms;
    right = roots.cwiseProduct(values);
  }
  const Eigen::VectorXd factors = terms.colPivHouseholderQr().solve(right);
  QuadraticSurface surface{factors[0], factors.segment(1, n), Eigen::MatrixXd(n, n)};
  for (Eigen::Index i = 0, term = 1 + n; i < n; ++i)
    for (Eigen::Index j = i; j < n; ++j, ++term) surface.hessian(i, j) = surface.hessian(j, i) = factors[term];
  return surface;
}

}  // namespace daumier::fitting
