#pragma once
#include "geometry/mesh.h"

#include <Eigen/Core>

#include <vector>

namespace daumier::geometry {

/// A point on an edge of a surface: (1 - share) * kept + share * removed.
struct EdgePoint {
  int kept, removed;  ///< The vertices at its ends.
  double share;
};

/// A surface without the part where a function of its vertices is positive. Vertices keep their numbers, those that
/// are removed too; the edge points follow them in the order of `points`.
struct LevelCut {
  std::vector<EdgePoint> points;
  Triangles triangles;  ///< Of vertices and edge points, oriented as before.
  TextureCoordinates uv{};
  Triangles uv_triangles{};
};

/// The least distance of an edge point from the ends of its edge, as a share of the edge: no triangle without area.
inline constexpr double kLeastEdgeShare = 0.02;

/// Cuts a mesh along the zero set of the piecewise linear function with these vertex values (V): triangles with three
/// positive corners are dropped, crossed ones are split at edge points, whose shares are kept in [kLeastEdgeShare,
/// 1 - kLeastEdgeShare]. A value of zero counts as negative. UV is interpolated along the edges of each triangle.
/// @throws Error unless there is one value a vertex, and as CheckUv.
LevelCut CutPositive(const TriangleMesh& mesh, const Eigen::VectorXd& values);

/// Vertices, then the edge points at these positions: (V + P) x 3.
Points WithEdgePoints(const Points& vertices, const std::vector<EdgePoint>& points);

}  // namespace daumier::geometry
