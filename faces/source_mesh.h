#pragma once
#include "geometry/mesh.h"
#include "geometry/path.h"
#include "geometry/topology.h"

#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace daumier::faces {

/// A source's polygons with the queries that an annotation needs repeatedly. Keeps a reference to the mesh. Messages
/// name the source and `what`, the entry of the annotation at hand.
class SourceMesh {
 public:
  SourceMesh(const geometry::PolygonMesh& mesh, std::string source);

  /// geometry::FindMirror to 0.05 cm; absent where the mesh is not its own mirror image.
  const std::optional<std::vector<int>>& mirror() const { return mirror_; }

  /// @throws Error if it is no vertex of the mesh.
  void CheckVertex(int vertex, const std::string& what) const;
  /// geometry::TracePath along polygon edges. @throws Error as it does, and as CheckVertex.
  std::vector<int> Trace(const std::vector<int>& waypoints, geometry::PathEnds ends, const std::string& what) const;
  /// The vertices on the other side, in the same order. @throws Error if the mesh is not its own mirror image.
  std::vector<int> Mirrored(std::vector<int> vertices, const std::string& what) const;
  /// The vertices of the polygons that are reached from those at `seed` without crossing one of the closed loops,
  /// ascending. @throws Error if the seed is a corner of no polygon.
  std::vector<int> Flood(int seed, const std::vector<std::vector<int>>& loops, const std::string& what) const;

 private:
  std::span<const int> Corners(int polygon) const;

  const geometry::PolygonMesh& mesh_;
  std::string source_;
  std::optional<std::vector<int>> mirror_;
  std::unordered_map<uint64_t, std::vector<int>> polygons_of_edge_;
  geometry::Adjacency neighbours_;
};

}  // namespace daumier::faces
