#pragma once
#include "rig/face_sides.h"
#include "tests/geometry/shapes.h"

#include <utility>

namespace daumier::testing {

/// A flat sheet with a straight slit from x = 0.25 to 0.75 at y = 0.5, its lips touching: the mouth of a template that faces
/// +z. n: squares a side, a multiple of 4.
struct SlitSheet {
  geometry::TriangleMesh mesh;
  rig::FaceSlits slits;
};

inline SlitSheet MakeSlitSheet(int n) {
  SlitSheet sheet{FlatSheet(n), {}};
  geometry::Points& points = sheet.mesh.vertices;
  const Eigen::RowVector3d low = points.colwise().minCoeff(), size = points.colwise().maxCoeff() - low;
  for (auto p : points.rowwise()) p = Eigen::RowVector3d((p.x() - low.x()) / size.x(), (p.y() - low.y()) / size.y(), 0);
  rig::SeamEdges edges;
  std::vector<int> doubles(size_t(points.rows()), -1);
  const int num_vertices = int(points.rows());
  for (int v = 0; v < num_vertices; ++v) {
    const double x = points(v, 0);
    if (std::abs(points(v, 1) - 0.5) > 1e-9 || x < 0.25 - 1e-9 || x > 0.75 + 1e-9) continue;
    edges.upper.push_back(v);
    if (x < 0.25 + 1e-9 || x > 0.75 - 1e-9) {
      edges.lower.push_back(v);
      continue;
    }
    doubles[size_t(v)] = int(points.rows());
    edges.lower.push_back(int(points.rows()));
    points.conservativeResize(points.rows() + 1, 3);
    points.row(points.rows() - 1) = points.row(v);
  }
  const auto by_x = [&](int a, int b) { return points(a, 0) < points(b, 0); };
  std::ranges::sort(edges.upper, by_x);
  std::ranges::sort(edges.lower, by_x);
  for (auto t : sheet.mesh.triangles.rowwise()) {
    double y = 0;
    for (const int v : t) y += points(v, 1) / 3;
    if (y > 0.5) continue;
    for (int& v : t)
      if (doubles[size_t(v)] >= 0) v = doubles[size_t(v)];
  }
  sheet.slits[size_t(rig::FaceSlit::kMouth)] = std::move(edges);
  return sheet;
}

}  // namespace daumier::testing
