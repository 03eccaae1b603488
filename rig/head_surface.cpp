#include "rig/head_surface.h"

#include "core/error.h"
#include "geometry/normals.h"
#include "geometry/submesh.h"
#include "geometry/weld.h"

#include <algorithm>

namespace daumier::rig {

int HeadSurface::num_components() const {
  return components.empty() ? 0 : 1 + *std::max_element(components.begin(), components.end());
}

HeadSurface MakeHeadSurface(const geometry::TriangleMesh& head) {
  const std::vector<int> lowest = geometry::WeldByPlace(head.vertices, geometry::WeldTolerance(head.vertices));
  std::vector<int> rows, used;
  for (int f = 0; f < head.triangles.rows(); ++f) {
    std::array<int, 3> corners{};
    for (int k = 0; k < 3; ++k) {
      const int v = head.triangles(f, k);
      DAUMIER_CHECK(v >= 0 && v < head.vertices.rows(), "triangle {} names vertex {}, there are {}", f, v,
                    head.vertices.rows());
      corners[size_t(k)] = lowest[size_t(v)];
    }
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
    rows.push_back(f);
    used.insert(used.end(), corners.begin(), corners.end());
  }
  DAUMIER_CHECK(!rows.empty(),
                "the head has no triangle whose corners lie apart; export its polygons at full precision");
  const geometry::VertexMap map = geometry::MapKept(used, int(head.vertices.rows()));
  HeadSurface surface;
  surface.mesh.vertices = geometry::SelectPoints(head.vertices, map);
  surface.mesh.triangles =
      head.triangles(rows, Eigen::all).unaryExpr([&](int v) { return map.new_from_old[size_t(lowest[size_t(v)])]; });
  surface.normals = geometry::VertexNormals(surface.mesh);
  surface.neighbours = geometry::VertexNeighbours(surface.mesh.triangles, surface.num_places());
  surface.components = geometry::ConnectedComponents(surface.neighbours);
  for (const int v : lowest) surface.places.push_back(map.new_from_old[size_t(v)]);
  return surface;
}

Eigen::MatrixXf OffsetsOfVertices(const HeadSurface& surface, const Eigen::MatrixXf& of_places) {
  Eigen::MatrixXf offsets = Eigen::MatrixXf::Zero(3 * std::ssize(surface.places), of_places.cols());
  for (Eigen::Index v = 0; v < std::ssize(surface.places); ++v)
    if (const int place = surface.places[size_t(v)]; place >= 0)
      offsets.middleRows(3 * v, 3) = of_places.middleRows(3 * Eigen::Index(place), 3);
  return offsets;
}

}  // namespace daumier::rig
