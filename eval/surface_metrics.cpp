#include "eval/surface_metrics.h"

#include "core/error.h"
#include "geometry/flips.h"
#include "geometry/normals.h"

#include <cmath>
#include <numbers>

namespace daumier::eval {

SurfaceMetrics CompareSurfaces(const geometry::TriangleMesh& truth, const geometry::Points& predicted) {
  DAUMIER_CHECK(predicted.rows() == truth.vertices.rows(), "the prediction has {} vertices and the truth {}",
                predicted.rows(), truth.vertices.rows());
  const geometry::Points true_normals = geometry::AreaNormals(truth),
                         normals = geometry::AreaNormals({predicted, truth.triangles});
  double sum = 0, area = 0;
  for (Eigen::Index f = 0; f < normals.rows(); ++f) {
    const geometry::Vector3 a = true_normals.row(f), b = normals.row(f);
    const double weight = a.norm();
    // Exact for small angles, where the cosine is not; atan2(0, 0) would be 0.
    const double angle = b.isZero(0) ? std::numbers::pi / 2 : std::atan2(a.cross(b).norm(), a.dot(b));
    sum += weight * angle;
    area += weight;
  }
  DAUMIER_CHECK(area > 0, "the true surface of {} triangles has no area", normals.rows());
  return {sum / area * 180 / std::numbers::pi,
          geometry::CountFlippedTriangles(truth.vertices, predicted, truth.triangles)};
}

}  // namespace daumier::eval
