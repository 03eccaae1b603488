#include "geometry/submesh.h"

#include "core/error.h"

#include <algorithm>

namespace daumier::geometry {

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
  std::vector<int> kept;
  for (int f = 0; f < triangles.rows(); ++f) {
    if ((triangles.row(f).unaryExpr([&](int v) { return map.new_from_old.at(v); }).array() >= 0).all())
      kept.push_back(f);
  }
  return triangles(kept, Eigen::all).unaryExpr([&](int v) { return map.new_from_old[v]; });
}

TriangleMesh Submesh(const TriangleMesh& mesh, const VertexMap& map) {
  return {SelectPoints(mesh.vertices, map), SelectTriangles(mesh.triangles, map)};
}

PolygonMesh Submesh(const PolygonMesh& mesh, const VertexMap& map) {
  PolygonMesh part;
  part.vertices = SelectPoints(mesh.vertices, map);
  for (int p = 0; p < mesh.num_polygons(); ++p) {
    const std::vector<int> corners(mesh.corners.begin() + mesh.offsets[p], mesh.corners.begin() + mesh.offsets[p + 1]);
    const std::vector<int> selected = SelectVertices(corners, map);
    if (selected.size() != corners.size()) continue;
    part.corners.insert(part.corners.end(), selected.begin(), selected.end());
    part.offsets.push_back(static_cast<int>(part.corners.size()));
  }
  return part;
}

}  // namespace daumier::geometry
