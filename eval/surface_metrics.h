#pragma once
#include "geometry/mesh.h"

/// Quality of a predicted surface in addition to vertex distances (eval/metrics.h), which do not detect folds.
namespace daumier::eval {

struct SurfaceMetrics {
  /// Mean angle in degrees between the normals of a triangle in both surfaces, weighted by its true area. A triangle
  /// without area in the prediction counts as 90.
  double normal_error_degrees = 0;
  /// geometry::CountFlippedTriangles from the true surface to the predicted one.
  int flipped_triangles = 0;
};

/// Of a prediction with the topology of the truth. Zero iff all normals agree. @throws Error if the number of vertices
/// differs, or the true surface has no area.
SurfaceMetrics CompareSurfaces(const geometry::TriangleMesh& truth, const geometry::Points& predicted);

}  // namespace daumier::eval
