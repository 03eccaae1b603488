#pragma once
#include "geometry/level_cut.h"

#include <functional>
#include <vector>

namespace daumier::geometry {

/// A place of a cut: the vertex of the triangles below it and that of those above; the same where the cut ends.
struct RimVertex {
  int below, above;
};

/// A part of a cut between two rim vertices, directed as its triangle below runs; the one above runs back.
struct RimEdge {
  int from, to;  ///< Rows of LineCut::rim.
  int triangle_below, triangle_above;
};

/// A surface that is open along a line.
struct LineCut {
  /// Vertices of before keep their numbers and places; points on edges follow, then copies. Whole triangles keep their
  /// rows; of a split one the first piece has its row, the others follow all.
  TriangleMesh mesh;
  std::vector<int> sources;  ///< One a triangle: the row of the one that it is a piece of.
  std::vector<RimVertex> rim;
  std::vector<RimEdge> edges;
  double length = 0;  ///< cm
};

/// The share of an edge within which the line goes through its end: no triangle without area.
inline constexpr double kSnapShare = 0.12;

/// Opens a mesh along the part of the zero line of a piecewise linear function with these vertex values (V) that
/// `is_on_line` accepts: triangles that it crosses are split, and what is below (negative) and above has vertices of its own
/// there, but at the ends. The surface stays where it is, with its orientation; UV is interpolated along the edges. A vertex on
/// the line is {v, v, 0}. Where a line does not divide what is around it, nothing is opened.
/// @throws Error unless there is one finite value a vertex, and as CheckUv.
LineCut CutAlongLine(const TriangleMesh& mesh, const Eigen::VectorXd& values,
                     const std::function<bool(const EdgePoint&)>& is_on_line);

}  // namespace daumier::geometry
