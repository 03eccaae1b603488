#pragma once
#include "geometry/mesh.h"

#include <cstddef>
#include <vector>

namespace daumier::geometry {

/// Quadrics of the vertices of a surface in several poses [Garland and Heckbert 1997; Mohr and Gleicher 2003]:
///   Q_v,p(x) = sum of w (n . (x - q))^2 over the planes (n, q) that belong to vertex v in pose p, cm^4.
/// Each is stored about the present place of its vertex in its pose, in float32.
class PoseQuadrics {
 public:
  /// rest: V x 3, cm, pose 0. offsets: 3V x T, cm, as rig::MorphTargets has them: pose t + 1 is rest + column t.
  /// @throws Error if a size differs.
  PoseQuadrics(const Points& rest, const Eigen::MatrixXf& offsets);

  int num_poses() const { return num_poses_; }

  /// The plane of a triangle in each pose, for its corners, with a third of its area in the pose times `weight`.
  void AddTriangle(int a, int b, int c, float weight);
  /// The plane through the edge a-b that is perpendicular to the triangle a-b-c, for a and b, with the squared length of the
  /// edge times `weight`.
  void AddEdge(int a, int b, int c, float weight);

  /// What it costs to put `from` where `to` is: Q_from + Q_to there, its mean over the poses plus that of the worst pose. In the
  /// mean pose 0 counts as often as makes the number of poses a multiple of eight.
  float Cost(int from, int to) const;
  /// Adds the quadrics of `from` to those of `to`.
  void Merge(int from, int to);

  /// Whether the triangle from-a-b is as good with `to` in place of `from`: its normal turns by less than 90 degrees in each
  /// pose and by less than 60 in pose 0, where it does not become a sliver either.
  bool MayMove(int from, int to, int a, int b) const;

 private:
  const float* PositionOf(int vertex) const { return positions_.data() + size_t(vertex) * 3 * stride_; }
  float* QuadricOf(int vertex) { return quadrics_.data() + size_t(vertex) * 10 * stride_; }
  const float* QuadricOf(int vertex) const { return quadrics_.data() + size_t(vertex) * 10 * stride_; }

  int num_poses_;
  size_t stride_;                 ///< num_poses_, rounded up to whole lanes, which hold pose 0 again.
  std::vector<float> positions_;  ///< V x (x of all poses, y, z).
  std::vector<float> quadrics_;   ///< V x (xx, xy, xz, yy, yz, zz, x, y, z, constant), each of all poses.
};

}  // namespace daumier::geometry
