#include "faces/source_mesh.h"

#include "core/error.h"
#include "geometry/path.h"
#include "geometry/triangulate.h"

#include <algorithm>
#include <numeric>
#include <set>

namespace daumier::faces {

namespace {

constexpr double kMirrorTolerance = 0.05;  // cm; artists' and statistical heads are symmetric to well below it

uint64_t EdgeKey(int a, int b) {
  return (static_cast<uint64_t>(std::min(a, b)) << 32) | static_cast<uint32_t>(std::max(a, b));
}

std::optional<std::vector<int>> MirrorOf(const geometry::Points& points) {
  try {
    return geometry::FindMirror(points, kMirrorTolerance);
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace

SourceMesh::SourceMesh(const geometry::PolygonMesh& mesh, std::string source)
    : mesh_(mesh), source_(std::move(source)), mirror_(MirrorOf(mesh.vertices)) {
  std::vector<std::pair<int, int>> pairs;
  for (int polygon = 0; polygon < mesh.num_polygons(); ++polygon) {
    const auto corners = Corners(polygon);
    for (size_t k = 0; k < corners.size(); ++k) {
      const int a = corners[k], b = corners[(k + 1) % corners.size()];
      polygons_of_edge_[EdgeKey(a, b)].push_back(polygon);
      pairs.emplace_back(a, b);
      pairs.emplace_back(b, a);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  neighbours_.offsets.assign(mesh.vertices.rows() + 1, 0);
  for (const auto& [vertex, neighbour] : pairs) {
    ++neighbours_.offsets[vertex + 1];
    neighbours_.values.push_back(neighbour);
  }
  std::partial_sum(neighbours_.offsets.begin(), neighbours_.offsets.end(), neighbours_.offsets.begin());
}

void SourceMesh::CheckVertex(int vertex, const std::string& what) const {
  DAUMIER_CHECK(vertex >= 0 && vertex < mesh_.vertices.rows(), "annotation of {}, {}: vertex {} is outside [0, {})",
                source_, what, vertex, mesh_.vertices.rows());
}

std::vector<int> SourceMesh::Trace(const std::vector<int>& waypoints, geometry::PathEnds ends,
                                   const std::string& what) const {
  for (const int vertex : waypoints) CheckVertex(vertex, what);
  try {
    return geometry::TracePath(mesh_.vertices, neighbours_, waypoints, ends);
  } catch (const Error& error) {
    throw Error(fmt::format("annotation of {}, {}: {}", source_, what, error.what()));
  }
}

std::vector<int> SourceMesh::Mirrored(std::vector<int> vertices, const std::string& what) const {
  DAUMIER_CHECK(
      mirror_.has_value(),
      "annotation of {}, {}: the mesh is not its own mirror image; specify both sides instead of mirroring one",
      source_, what);
  for (int& vertex : vertices) vertex = (*mirror_)[vertex];
  return vertices;
}

std::vector<int> SourceMesh::Flood(int seed, const std::vector<std::vector<int>>& loops,
                                   const std::string& what) const {
  CheckVertex(seed, what);
  std::set<uint64_t> walls;
  for (const auto& loop : loops) {
    for (size_t i = 0; i < loop.size(); ++i) walls.insert(EdgeKey(loop[i], loop[(i + 1) % loop.size()]));
  }
  std::vector<char> reached(mesh_.num_polygons(), 0);
  std::vector<int> open;
  for (int polygon = 0; polygon < mesh_.num_polygons(); ++polygon) {
    const auto corners = Corners(polygon);
    if (std::find(corners.begin(), corners.end(), seed) == corners.end()) continue;
    reached[polygon] = 1;
    open.push_back(polygon);
  }
  DAUMIER_CHECK(!open.empty(), "annotation of {}, {}: seed {} is a corner of no polygon", source_, what, seed);
  std::set<int> vertices;
  while (!open.empty()) {
    const auto corners = Corners(open.back());
    open.pop_back();
    for (size_t k = 0; k < corners.size(); ++k) {
      vertices.insert(corners[k]);
      const uint64_t edge = EdgeKey(corners[k], corners[(k + 1) % corners.size()]);
      if (walls.count(edge)) continue;
      for (const int next : polygons_of_edge_.at(edge)) {
        if (reached[next]) continue;
        reached[next] = 1;
        open.push_back(next);
      }
    }
  }
  return {vertices.begin(), vertices.end()};
}

std::span<const int> SourceMesh::Corners(int polygon) const {
  return std::span(mesh_.corners).subspan(mesh_.offsets[polygon], mesh_.offsets[polygon + 1] - mesh_.offsets[polygon]);
}

}  // namespace daumier::faces
