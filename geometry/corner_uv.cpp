#include "geometry/corner_uv.h"

#include "core/error.h"
#include "geometry/submesh.h"

#include <algorithm>
#include <span>

namespace daumier::geometry {
namespace {

std::span<const int> Flat(const Triangles& triangles) {
  return {triangles.data(), static_cast<size_t>(triangles.size())};
}

void Check(const TextureCoordinates& uv, std::span<const int> uv_corners, size_t num_corners) {
  const size_t expected = uv.rows() > 0 ? num_corners : 0;
  DAUMIER_CHECK(uv_corners.size() == expected, "UV of {} corners, expected {} (the mesh has {} rows of UV)",
                uv_corners.size(), expected, uv.rows());
  for (const int row : uv_corners) {
    DAUMIER_CHECK(row >= 0 && row < uv.rows(), "a corner uses row {} of UV, there are {}", row, uv.rows());
  }
  DAUMIER_CHECK(uv.allFinite(), "UV is not finite");
}

/// Renumbers `uv_corners` and selects the rows they use.
void RemoveUnused(TextureCoordinates& uv, std::span<int> uv_corners) {
  const VertexMap map = MapKept({uv_corners.begin(), uv_corners.end()}, static_cast<int>(uv.rows()));
  uv = TextureCoordinates(uv(map.old_from_new, Eigen::all));
  for (int& row : uv_corners) row = map.new_from_old[row];
}

}  // namespace

void CheckUv(const TriangleMesh& mesh) {
  Check(mesh.uv, Flat(mesh.uv_triangles), static_cast<size_t>(mesh.triangles.size()));
}

void CheckUv(const PolygonMesh& mesh) {
  Check(mesh.uv, mesh.uv_corners, mesh.corners.size());
}

void RemoveUnusedUv(TriangleMesh& mesh) {
  RemoveUnused(mesh.uv, {mesh.uv_triangles.data(), static_cast<size_t>(mesh.uv_triangles.size())});
}

void RemoveUnusedUv(PolygonMesh& mesh) {
  RemoveUnused(mesh.uv, mesh.uv_corners);
}

}  // namespace daumier::geometry
