#include "raster/mesh_topology.h"

#include "core/error.h"

#include <algorithm>
#include <tuple>

namespace daumier::raster {

MeshTopology MakeTopology(std::span<const int> corners, int num_vertices) {
  DAUMIER_CHECK(corners.size() % 3 == 0, "triangles have {} corners, expected a multiple of 3", corners.size());
  MeshTopology topology{.num_vertices = num_vertices, .triangles = {}, .edges = {}};
  struct Side {
    int first, second, triangle, corner;
  };
  std::vector<Side> sides;
  topology.triangles.reserve(corners.size() / 3);
  sides.reserve(corners.size());
  for (size_t i = 0; i < corners.size(); i += 3) {
    const std::array<int, 3> triangle = {corners[i], corners[i + 1], corners[i + 2]};
    const int row = topology.num_triangles();
    for (const int vertex : triangle) {
      DAUMIER_CHECK(vertex >= 0 && vertex < num_vertices, "triangle {} has vertex {}, expected 0..{}", row, vertex,
                    num_vertices - 1);
    }
    topology.triangles.push_back(triangle);
    if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) continue;
    for (int k = 0; k < 3; ++k) {
      const auto [first, second] = std::minmax(triangle[(k + 1) % 3], triangle[(k + 2) % 3]);
      sides.push_back({first, second, row, triangle[k]});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.first, a.second, a.triangle) < std::tie(b.first, b.second, b.triangle);
  });
  for (size_t i = 0; i < sides.size(); ++i) {
    const auto same_edge = [&](size_t k) {
      return k < sides.size() && sides[k].first == sides[i].first && sides[k].second == sides[i].second;
    };
    const bool is_first = i == 0 || !same_edge(i - 1), has_next = same_edge(i + 1);
    if (!has_next && !is_first) continue;  // The last of its edge's sides is in the edge before.
    MeshEdge edge{sides[i].first, sides[i].second, {sides[i].triangle, -1}, {sides[i].corner, -1}};
    if (has_next) edge.triangle[1] = sides[i + 1].triangle, edge.corner[1] = sides[i + 1].corner;
    topology.edges.push_back(edge);
  }
  return topology;
}

}  // namespace daumier::raster
