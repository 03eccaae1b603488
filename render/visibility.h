#pragma once
#include "geometry/mesh.h"
#include "render/camera.h"
#include "render/rasteriser.h"

namespace daumier::render {

/// Visibility of surface points by a depth map of the camera's size. A point counts as hidden if all of the
/// 3 x 3 pixels around it show something that is nearer by more than the tolerance: neither its own triangle nor the
/// steep neighbour at a contour hides it, and an occluder uncovers at most a pixel and a half at its border. Points
/// outside of the picture are seen.
class Visibility {
 public:
  /// `tolerance` in cm. @throws Error as Rasterise, and if the tolerance is negative.
  Visibility(const Camera& camera, const geometry::TriangleMesh& occluders, double tolerance);

  /// The same from a depth map at hand, in cm, of the camera's size; its triangles and barycentrics are not read.
  /// @throws Error if a size differs or the tolerance is negative.
  Visibility(const Camera& camera, Raster depth, double tolerance);

  /// @param projected a row of Project: x and y in pixels and the depth in cm.
  bool Sees(const Eigen::RowVector3d& projected) const;

  const Camera& camera() const { return camera_; }

 private:
  Camera camera_;
  double tolerance_;
  Raster raster_;
};

}  // namespace daumier::render
