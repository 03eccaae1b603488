#pragma once
#include "geometry/mesh.h"
#include "geometry/topology.h"

#include <array>
#include <vector>

namespace daumier::geometry {

/// What a displacement has done to a surface.
struct SurfaceDefects {
  std::vector<int> turned;  ///< Triangles that are turned over, ascending.
  std::vector<int> folded;  ///< Edges that are folded, by FlipRepair's own numbers, ascending.

  bool empty() const { return turned.empty() && folded.empty(); }
};

/// Relaxes displacements d of a surface f that turn triangles over or fold edges. The orientation of a triangle with
/// edges e1, e2 on f and differences d1, d2 of d along them is
///   g(t) = r . ((e1 + t d1) x (e2 + t d2)),
/// r its normal on a reference surface, of any length. It is turned over if g(1) <= 0 < g(0). Then its corners' d are
/// drawn to their mean until g >= kMargin g(0), which is so where all three are equal. An edge is folded if its two triangles
/// include less than kFoldDegrees, and do neither on f nor on the reference; the d of their four corners are drawn to their mean until it is not.
/// So defects of f itself do not count. One after the other is relaxed, in passes, for neighbours may be turned over by that. Displacements
/// in a plane stay in it. Thread-safe.
class FlipRepair {
 public:
  static constexpr double kMargin = 0.1, kFoldDegrees = 30;

  /// @throws Error if a triangle's corner is out of range.
  FlipRepair(Triangles triangles, int num_vertices);

  /// surface, displacement: V x 3; normals: r, F x 3 (AreaNormals of the reference). @throws Error if a shape disagrees.
  SurfaceDefects Find(const Points& surface, const Points& normals, const Points& displacement) const;

  /// Changes d next to `defects` (of Find) in at most that many passes, and returns those that are left.
  SurfaceDefects Relax(const Points& surface, const Points& normals, SurfaceDefects defects, int passes,
                       Points& displacement) const;

 private:
  /// An edge between two triangles.
  struct InnerEdge {
    std::array<int, 2> triangles;
    std::array<int, 4> corners;
  };

  bool IsTurned(const Points& surface, const Points& normals, const Points& displacement, int triangle) const;
  bool IsFolded(const Points& surface, const Points& normals, const Points& displacement, int edge) const;
  void TurnBack(const Points& surface, const Points& normals, int triangle, Points& displacement) const;
  void Unfold(const Points& surface, const Points& normals, int edge, Points& displacement) const;
  /// Defects of the triangles at these vertices.
  SurfaceDefects FindAt(std::vector<int> vertices, const Points& surface, const Points& normals,
                        const Points& displacement) const;

  Triangles triangles_;
  Adjacency at_vertices_;
  std::vector<InnerEdge> edges_;
  std::vector<std::array<int, 3>> edges_of_triangle_;  ///< -1 at a border.
};

}  // namespace daumier::geometry
