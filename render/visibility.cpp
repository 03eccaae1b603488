#include "render/visibility.h"

#include "core/error.h"

#include <cmath>
#include <utility>

namespace daumier::render {

Visibility::Visibility(const Camera& camera, const geometry::TriangleMesh& occluders, double tolerance)
    : Visibility(camera, Rasterise(camera, occluders), tolerance) {}

Visibility::Visibility(const Camera& camera, Raster depth, double tolerance)
    : camera_(camera), tolerance_(tolerance), raster_(std::move(depth)) {
  DAUMIER_CHECK(tolerance >= 0, "a depth map with the tolerance {} cm, expected 0 or more", tolerance);
  DAUMIER_CHECK(raster_.height == camera.height && raster_.width == camera.width &&
                    raster_.depth.size() == size_t(camera.height) * camera.width,
                "a depth map of {} x {} for a camera of {} x {}", raster_.height, raster_.width, camera.height,
                camera.width);
}

bool Visibility::Sees(const Eigen::RowVector3d& projected) const {
  const double x = std::floor(projected.x()), y = std::floor(projected.y());
  if (!(x >= 0 && y >= 0 && x < raster_.width && y < raster_.height)) return true;
  const int row = static_cast<int>(y), column = static_cast<int>(x);
  for (int r = row - 1; r <= row + 1; ++r) {
    for (int c = column - 1; c <= column + 1; ++c) {
      const bool is_outside = r < 0 || c < 0 || r >= raster_.height || c >= raster_.width;
      if (is_outside || projected.z() <= raster_.depth[raster_.index(r, c)] + tolerance_) return true;
    }
  }
  return false;
}

}  // namespace daumier::render
