#pragma once

#include "geometry/mesh.h"

#include <Eigen/Core>

#include <vector>

namespace daumier::rig {

/// Two edges of skin that meet, those of lids or of lips: paths of vertices from the right corner to the left one, both
/// of which they share.
struct SeamEdges {
  std::vector<int> upper, lower;
};

/// Axes of unit length: along a seam to the face's left, up from its lower to its upper edge, and out of the skin.
struct SeamFrame {
  Eigen::Vector3d along, up, out;
};
/// `along` from the first to the last vertex of the upper edge; `out` is the part of `towards` that is perpendicular to
/// it. points: V x 3.
SeamFrame FrameOfSeam(const SeamEdges& edges, const geometry::Points& points, const Eigen::Vector3d& towards);

/// How far out edges meet: as far as the point between them, or as the farther one.
enum class SeamDepth { kBetween, kFarther };

/// Moves the edges of a seam and the skin around them. A vertex of the edge with fewer vertices faces one of the other
/// edge, in order and as near as can be by the share of the length from the right corner on the neutral face, summed in
/// the least-squares sense; what is between two such vertices faces the point that divides it alike. So both edges can
/// come to lie on each other along their whole length.
class Seam {
 public:
  /// The skin within `num_rings` edges of the mesh follows the edges, less with every ring.
  /// @throws Error if an edge has fewer than three vertices, or they have other ends.
  Seam(const geometry::TriangleMesh& neutral, SeamEdges edges, int num_rings);

  const SeamEdges& edges() const { return edges_; }

  /// Brings both edges to one curve: between points that face each other, `upper_share` of the way from the upper edge
  /// to the lower one. pose: V x 3.
  void Join(const SeamFrame& frame, double upper_share, SeamDepth depth, geometry::Points& pose) const;
  /// Join for lids or lips that close: skin of the upper side within three rings that is below the curve then is lifted
  /// to it, that of the lower side above it lowered, less towards the corners.
  void Meet(const SeamFrame& frame, double upper_share, SeamDepth depth, geometry::Points& pose) const;
  /// Moves the edges apart where they leave less than `kept_share` of the height between them at `rest`, or where they
  /// cross there, where they cross deeper, until that is so within 0.002 cm, at most eight times. A share of 0 lets them
  /// close but not cross.
  void KeepApart(const SeamFrame& frame, const geometry::Points& rest, double kept_share, geometry::Points& pose) const;

  /// Height of the upper edge over the lower one, across the seam and not `out`, at each inner vertex of both: negative
  /// where they cross.
  std::vector<double> Heights(const SeamFrame& frame, const geometry::Points& pose) const;
  /// Distances of the inner vertices of each edge to the other edge.
  std::vector<double> Gaps(const geometry::Points& pose) const;

 private:
  enum class Side : char { kBoth, kUpper, kLower };
  struct Follower {
    int vertex, ring;
    Side side;
    double share;              ///< Where along the seam, 0 .. 1: points of equal shares face each other.
    std::vector<int> parents;  ///< Places in followers_ of the neighbours in the ring before.
  };
  Eigen::Vector3d PointAt(const geometry::Points& pose, Side edge, double share) const;
  Eigen::Vector3d Across(const SeamFrame& frame, const geometry::Points& pose, double share) const;
  void Follow(const std::vector<Eigen::Vector3d>& moves, geometry::Points& pose) const;
  void Clamp(const SeamFrame& frame, geometry::Points& pose) const;
  /// The height of the upper edge over the lower one at each follower of ring 0.
  std::vector<double> HeightsOfEdges(const SeamFrame& frame, const geometry::Points& pose) const;

  SeamEdges edges_;
  std::vector<double> upper_shares_, lower_shares_;  ///< Of the vertices of the edges.
  int num_rings_;
  int num_edge_vertices_ = 0;
  std::vector<Follower> followers_;  ///< The vertices of the edges, ring 0, then ring by ring.
};

}  // namespace daumier::rig
