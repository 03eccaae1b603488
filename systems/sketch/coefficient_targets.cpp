#include "systems/sketch/coefficient_targets.h"

#include "core/error.h"
#include "datasets/build/interpolation.h"

#include <algorithm>

namespace daumier::sketch {

CoefficientTargets::CoefficientTargets(const faces::FaceDatabase& database, std::vector<int> identities,
                                       const faces::BilinearModel& model)
    : database_(database), identities_(std::move(identities)), model_(model), projector_(model) {}

Eigen::Index CoefficientTargets::Row(const faces::FaceId& face) const {
  const int identity = face.person * database_.num_levels() + face.level;
  const auto found = std::lower_bound(identities_.begin(), identities_.end(), identity);
  return found == identities_.end() || *found != identity ? -1 : found - identities_.begin();
}

faces::BilinearProjection CoefficientTargets::Of(int face) const {
  const auto u = [&](Eigen::Index row) -> Eigen::VectorXf { return model_.identity_factors.row(row).transpose(); };
  const auto v = [&](int expression) -> Eigen::VectorXf {
    return model_.expression_factors.row(expression).transpose();
  };
  if (face < database_.num_grid_faces()) {
    const faces::FaceId id = database_.id(face);
    const Eigen::Index row = Row(id);
    DAUMIER_CHECK(row >= 0, "{} was not fitted, and so has no coefficients", database_.Describe(face));
    return {u(row), v(id.expression), {}};
  }
  const auto [a, b, s, t] = datasets::ReadInterpolation(database_, face);
  const Eigen::Index row_a = Row(a), row_b = Row(b);
  if (row_a < 0 || row_b < 0) return projector_.Project(database_.vertices(face));
  return {(1 - s) * u(row_a) + s * u(row_b), (1 - t) * v(a.expression) + t * v(b.expression), {}};
}

}  // namespace daumier::sketch
