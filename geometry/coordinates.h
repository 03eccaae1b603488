#pragma once
#include "geometry/mesh.h"

#include <span>

namespace daumier::geometry {

/// V x 3 from interleaved coordinates x0 y0 z0 x1 ...
inline Points PointsFrom(std::span<const float> coordinates) {
  using Rows = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
  return Eigen::Map<const Rows>(coordinates.data(), Eigen::Index(coordinates.size() / 3), 3).cast<double>();
}

}  // namespace daumier::geometry
