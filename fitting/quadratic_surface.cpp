#include "fitting/quadratic_surface.h"

#include "core/error.h"

#include <Eigen/QR>

#include <algorithm>

namespace daumier::fitting {
namespace {

constexpr double kCorner = 0.7;
constexpr int kDescentSteps = 200;

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

QuadraticSurface FitQuadraticSurface(const Eigen::MatrixXd& places, const Eigen::VectorXd& values) {
  const Eigen::Index n = places.cols(), num_terms = (n + 1) * (n + 2) / 2;
  DAUMIER_CHECK(
      places.rows() == values.size() && places.rows() >= num_terms && places.allFinite() && values.allFinite(),
      "{} values at {} places do not determine a quadratic surface of {} variables (expected {} finite ones)",
      values.size(), places.rows(), n, num_terms);
  Eigen::MatrixXd terms(places.rows(), num_terms);
  terms.col(0).setOnes();
  terms.middleCols(1, n) = places;
  for (Eigen::Index i = 0, term = 1 + n; i < n; ++i)
    for (Eigen::Index j = i; j < n; ++j, ++term)
      terms.col(term) = (i == j ? 0.5 : 1.0) * places.col(i).cwiseProduct(places.col(j));
  const Eigen::VectorXd weights = terms.colPivHouseholderQr().solve(values);
  QuadraticSurface surface{weights[0], weights.segment(1, n), Eigen::MatrixXd(n, n)};
  for (Eigen::Index i = 0, term = 1 + n; i < n; ++i)
    for (Eigen::Index j = i; j < n; ++j, ++term) surface.hessian(i, j) = surface.hessian(j, i) = weights[term];
  return surface;
}

}  // namespace daumier::fitting
