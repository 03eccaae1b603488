#pragma once
#include "geometry/mesh.h"

#include <span>
#include <string_view>
#include <vector>

namespace daumier::geometry {

/// Collects the polygons of a file while it is read: the rules that all mesh readers share.
/// A vertex that a polygon repeats is kept once; a polygon with fewer than three corners left is skipped. A mesh has UV
/// at every corner or nowhere: if some corners have none or one that is not finite, all UV is dropped. Finish logs one
/// warning for either rule; no warning where no corner has UV.
class PolygonCollector {
 public:
  static constexpr int kNoUv = -1;

  /// `uv_corners`: a row of UV or kNoUv for each corner. O(n log n) in the number of corners.
  void Add(std::span<const int> corners, std::span<const int> uv_corners);

  /// From now on the row of UV of a corner is its vertex: for files with UV of vertices.
  void UseVertexUv() { mesh_.uv_corners = mesh_.corners; }

  /// The mesh of the collected polygons; `name` is the file in warnings. Every corner must be a row of its table.
  PolygonMesh Finish(Points vertices, TextureCoordinates uv, std::string_view name) &&;

 private:
  void KeepWholeUv(TextureCoordinates uv, std::string_view name);

  PolygonMesh mesh_;
  std::vector<int> sorted_;
  int num_repeating_ = 0, num_skipped_ = 0;
};

}  // namespace daumier::geometry
