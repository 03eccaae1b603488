#pragma once
#include "geometry/mesh.h"

#include <span>

namespace daumier::geometry {

/// The vertices whose coordinates x, y, z stand one after the other.
inline Points PointsFrom(std::span<const float> coordinates) {
  using Rows = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
  return Eigen::Map<const Rows>(coordinates.data(), Eigen::Index(coordinates.size() / 3), 3).cast<double>();
}

}  // namespace daumier::geometry
