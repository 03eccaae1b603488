#pragma once
#include "geometry/mesh.h"

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace daumier::geometry {

/// Collects the polygons of a file while it is read: the rules that all mesh readers share.
/// A vertex that a polygon repeats is kept once; a polygon with fewer than three corners left is skipped, as is one with
/// a corner at a position that is not finite. Vertices keep their numbers: one that is not finite stays in its row as it
/// is, without a polygon. A mesh has UV at every corner or nowhere: if some corners have none or one that is not finite,
/// all UV is dropped. Finish logs one warning that counts all of that, and another for UV that is dropped; no warning
/// where no corner has UV.
class PolygonCollector {
 public:
  static constexpr int kNoUv = -1;

  /// `uv_corners`: a row of UV or kNoUv for each corner. O(n log n) in the number of corners.
  void Add(std::span<const int> corners, std::span<const int> uv_corners);

  /// From now on the row of UV of a corner is its vertex: for files with UV of vertices.
  void UseVertexUv() { mesh_.uv_corners = mesh_.corners; }

  /// Elements of the file that are no polygons and are skipped: points, lines, curves.
  void CountOtherElements(int num_others) { num_others_ += num_others; }

  /// The mesh of the collected polygons; `name` is the file in warnings. Every corner must be a row of its table.
  /// @throws Error if no polygon is left.
  PolygonMesh Finish(Points vertices, TextureCoordinates uv, std::string_view name) &&;

 private:
  /// Skips the polygons with a corner at such a position.
  void DropNotFinite();
  void KeepWholeUv(TextureCoordinates uv, std::string_view name);

  PolygonMesh mesh_;
  std::vector<int> sorted_;
  int num_repeating_ = 0, num_short_ = 0, num_not_finite_ = 0, num_others_ = 0;
};

/// @throws Error "name: a cloud of points ..." with the repair: for a file with vertices and no faces.
[[noreturn]] void RefuseCloud(std::string_view name, int64_t num_vertices);

/// For meshes whose topology must match: their vertices all have a place. @throws Error naming `name` and the first
/// vertex that is not finite.
void CheckFinite(const Points& vertices, std::string_view name);

}  // namespace daumier::geometry
