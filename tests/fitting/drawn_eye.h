#pragma once
#include "fitting/texture_iris.h"

#include <algorithm>
#include <cmath>

namespace daumier::fitting {

constexpr int kEyeSide = 160;

/// A picture of an eye: an almond of grey white with a dark iris of blue; what lies above `lid` is of another class.
inline PictureLayer DrawnEye(const Eigen::Vector2d& middle, const IrisDisc& iris, double lid = 0) {
  PictureLayer layer{kEyeSide, kEyeSide, std::vector<float>(3 * kEyeSide * kEyeSide, 0.5F),
                     std::vector<float>(kEyeSide * kEyeSide, 0.0F), 0};
  for (int row = 0; row < kEyeSide; ++row) {
    for (int column = 0; column < kEyeSide; ++column) {
      const double x = column + 0.5, y = row + 0.5;
      if (std::hypot((x - middle.x()) / 40, (y - middle.y()) / 24) > 1 || y < lid) continue;
      const size_t pixel = size_t(row) * kEyeSide + size_t(column);
      const bool is_iris = std::hypot(x - iris.centre.x(), y - iris.centre.y()) < iris.radius;
      const Eigen::Vector3f colour = is_iris ? Eigen::Vector3f(0.1F, 0.2F, 0.5F) : Eigen::Vector3f(0.8F, 0.8F, 0.8F);
      std::copy_n(colour.data(), 3, layer.colours.begin() + ptrdiff_t(3 * pixel));
      layer.confidence[pixel] = 1;
      ++layer.num_known;
    }
  }
  return layer;
}

}  // namespace daumier::fitting
