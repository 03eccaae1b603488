#include "geometry/flips.h"

#include "core/error.h"

#include <Eigen/Geometry>

namespace daumier::geometry {

std::vector<int> FlippedTriangles(const Points& before, const Points& after, const Triangles& triangles,
                                  const std::vector<int>& subset) {
  DAUMIER_CHECK(before.rows() == after.rows(), "{} vertices before, {} after", before.rows(), after.rows());
  std::vector<bool> is_inside(before.rows(), subset.empty());
  for (const int v : subset) is_inside[v] = true;
  const auto area_normal = [&](const Points& points, int f) -> Eigen::Vector3d {
    const Eigen::RowVector3d origin = points.row(triangles(f, 0));
    return (points.row(triangles(f, 1)) - origin).cross(points.row(triangles(f, 2)) - origin);
  };
  std::vector<int> flipped;
  for (int f = 0; f < triangles.rows(); ++f) {
    if (!is_inside[triangles(f, 0)] || !is_inside[triangles(f, 1)] || !is_inside[triangles(f, 2)]) continue;
    const Eigen::Vector3d normal = area_normal(before, f);
    if (!(normal.dot(area_normal(after, f)) > 0) && normal.squaredNorm() > 0) flipped.push_back(f);
  }
  return flipped;
}

int CountFlippedTriangles(const Points& before, const Points& after, const Triangles& triangles,
                          const std::vector<int>& subset) {
  return static_cast<int>(FlippedTriangles(before, after, triangles, subset).size());
}

}  // namespace daumier::geometry
