#include "geometry/submesh.h"

#include "core/error.h"
#include "geometry/corner_uv.h"

#include <algorithm>

namespace daumier::geometry {
namespace {

/// The rows of the triangles whose corners were all kept.
std::vector<int> KeptTriangles(const Triangles& triangles, const VertexMap& map) {
  std::vector<int> kept;
  for (int f = 0; f < triangles.rows(); ++f) {
    if ((triangles.row(f).unaryExpr([&](int v) { return map.new_from_old.at(v); }).array() >= 0).all())
      kept.push_back(f);
  }
  return kept;
}

Triangles Renumber(const Triangles& triangles, const std::vector<int>& kept, const VertexMap& map) {
  return triangles(kept, Eigen::all).unaryExpr([&](int v) { return map.new_from_old[v]; });
}

}  // namespace

VertexMap MapKept(const std::vector<int>& kept, int num_vertices) {
  VertexMap map{std::vector<int>(num_vertices, -1), kept};
  std::sort(map.old_from_new.begin(), map.old_from_new.end());
  map.old_from_new.erase(std::unique(map.old_from_new.begin(), map.old_from_new.end()), map.old_from_new.end());
  for (size_t i = 0; i < map.old_from_new.size(); ++i) {
    const int old = map.old_from_new[i];
    DAUMIER_CHECK(old >= 0 && old < num_vertices, "vertex {} is out of range, there are {}", old, num_vertices);
    map.new_from_old[old] = static_cast<int>(i);
  }
  return map;
}

std::vector<int> SelectVertices(const std::vector<int>& vertices, const VertexMap& map) {
  std::vector<int> selected;
  for (const int v : vertices) {
    if (map.new_from_old.at(v) >= 0) selected.push_back(map.new_from_old[v]);
  }
  return selected;
}

Points SelectPoints(const Points& points, const VertexMap& map) {
  return points(map.old_from_new, Eigen::all);
}

Triangles SelectTriangles(const Triangles& triangles, const VertexMap& map) {
  return Renumber(triangles, KeptTriangles(triangles, map), map);
}

TriangleMesh Submesh(const TriangleMesh& mesh, const VertexMap& map) {
  CheckUv(mesh);
  const std::vector<int> kept = KeptTriangles(mesh.triangles, map);
  TriangleMesh part{SelectPoints(mesh.vertices, map), Renumber(mesh.triangles, kept, map)};
  if (!mesh.has_uv()) return part;
  part.uv = mesh.uv;
  part.uv_triangles = mesh.uv_triangles(kept, Eigen::all);
  RemoveUnusedUv(part);
  return part;
}

PolygonMesh Submesh(const PolygonMesh& mesh, const VertexMap& map) {
  CheckUv(mesh);
  PolygonMesh part{.vertices = SelectPoints(mesh.vertices, map), .uv = mesh.uv};
  for (int p = 0; p < mesh.num_polygons(); ++p) {
    const auto begin = mesh.offsets[p], end = mesh.offsets[p + 1];
    const std::vector<int> corners(mesh.corners.begin() + begin, mesh.corners.begin() + end);
    const std::vector<int> selected = SelectVertices(corners, map);
    if (selected.size() != corners.size()) continue;
    part.corners.insert(part.corners.end(), selected.begin(), selected.end());
    part.offsets.push_back(static_cast<int>(part.corners.size()));
    if (!mesh.has_uv()) continue;
    part.uv_corners.insert(part.uv_corners.end(), mesh.uv_corners.begin() + begin, mesh.uv_corners.begin() + end);
  }
  RemoveUnusedUv(part);
  return part;
}

}  // namespace daumier::geometry
