#include "geometry/moving_least_squares.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>

namespace daumier::geometry {
namespace {

using Eigen::Vector2d;

/// Keeps weights finite at a handle, in pixels to the fourth.
constexpr double kNearest = 1e-8;

double Weight(double squared_distance) {
  return 1.0 / (squared_distance * squared_distance + kNearest);
}

}  // namespace

MovingLeastSquares::MovingLeastSquares(const std::vector<Vector2d>& handles, const std::vector<Vector2d>& targets,
                                       PlanarMap kind)
    : kind_(kind) {
  DAUMIER_CHECK(handles.size() == targets.size(), "{} handles have {} targets", handles.size(), targets.size());
  for (size_t i = 0; i < handles.size(); ++i) {
    const auto same = std::find_if(handles_.begin(), handles_.end(),
                                   [&](const Handle& handle) { return handle.position == handles[i]; });
    if (same == handles_.end()) {
      handles_.push_back({handles[i], targets[i]});
    } else {
      same->multiplicity += 1;
      same->target += (targets[i] - same->target) / same->multiplicity;
    }
  }
}

Vector2d MovingLeastSquares::Apply(const Vector2d& point) const {
  if (handles_.empty()) return point;
  if (handles_.size() == 1) return point + (handles_.front().target - handles_.front().position);

  // Centroids, relative to the point: no digits are lost next to a handle.
  double total = 0;
  Vector2d source_centre = Vector2d::Zero(), target_centre = Vector2d::Zero();
  for (const Handle& handle : handles_) {
    const Vector2d p = handle.position - point;
    const double weight = handle.multiplicity * Weight(p.squaredNorm());
    total += weight;
    source_centre += weight * p;
    target_centre += weight * (handle.target - point);
  }
  source_centre /= total;
  target_centre /= total;

  // The best turn and scale as a complex number, sum w conj(p) q / sum w |p|^2.
  double real = 0, imaginary = 0, spread = 0;
  for (const Handle& handle : handles_) {
    const Vector2d from_point = handle.position - point;
    const double weight = handle.multiplicity * Weight(from_point.squaredNorm());
    const Vector2d p = from_point - source_centre, q = handle.target - point - target_centre;
    real += weight * p.dot(q);
    imaginary += weight * (p.x() * q.y() - p.y() * q.x());
    spread += weight * p.squaredNorm();
  }
  if (kind_ == PlanarMap::kRigid) spread = std::sqrt(real * real + imaginary * imaginary);
  if (spread > 0) {
    real /= spread;
    imaginary /= spread;
  } else {  // All targets of a rigid map in one point: every turn is as good as none.
    real = 1;
    imaginary = 0;
  }
  return point + target_centre +
         Vector2d(imaginary * source_centre.y() - real * source_centre.x(),
                  -imaginary * source_centre.x() - real * source_centre.y());
}

}  // namespace daumier::geometry
