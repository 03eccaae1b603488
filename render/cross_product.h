#pragma once
#include <Eigen/Core>

namespace daumier::render {

/// The signed area of the parallelogram of a and b: positive where b points to the left of a with y up.
inline double CrossProduct(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace daumier::render
