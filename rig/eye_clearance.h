#pragma once

#include "faces/eyeball.h"
#include "geometry/topology.h"
#include "rig/seam.h"

#include <Eigen/Core>

#include <vector>

namespace daumier::rig {

/// The eyeball that a head is shipped with: a sphere, which turns within itself, 0.05 cm behind the fitted one and with
/// 0.35 of its cornea's bulge, so that lids clear it when it turns.
faces::Eyeball SetBack(const faces::Eyeball& fitted);

/// Distance of a point from an eyeball that looks along `gaze` (of unit length), along the ray from its centre, cm:
/// negative inside, and never nearer to 0 there than the true depth.
double EyeClearance(const faces::Eyeball& eyeball, const Eigen::Vector3d& gaze, const Eigen::Vector3d& point);

/// Where an eye looks that is turned by degrees to the face's left (+x) and down.
Eigen::Vector3d GazeOf(double left_degrees, double down_degrees);

/// A gaze that turns while a target goes from weight 0 to 1: what the eye of weight t sees along is GazeOf(t times these).
struct GazeTurn {
  double left_degrees = 0, down_degrees = 0;
};

/// The skin around an eye, which stays in front of the ball.
class EyeSkin {
 public:
  /// The vertices and triangles within 1.2 w of the middle of the loop between the lids on the neutral face, w the
  /// loop's extent along x; without what is behind the lids' edges, between these and the loop, where lids have a
  /// thickness: it hardly shows, and rubs on the ball.
  EyeSkin(const geometry::TriangleMesh& neutral, const std::vector<int>& lids, const SeamEdges& edges);

  /// The greatest length of an offset of its vertices, cm. offset: 3V.
  double GreatestMove(const Eigen::VectorXf& offset) const;

  /// Least clearance of vertices, of middles of edges and of triangles, cm: positive where all are outside the ball.
  double LeastClearance(const faces::Eyeball& eyeball, const Eigen::Vector3d& gaze, const geometry::Points& pose) const;

  /// Moves `pose` out along rays from the ball's centre, smoothly, so that a face that goes straight from `rest` to it
  /// stays outside the ball at 0.15, 0.3, 0.5, 0.75 and the whole of the way, where it is outside at rest.
  void KeepOutside(const faces::Eyeball& eyeball, const GazeTurn& turn, const geometry::Points& rest,
                   geometry::Points& pose) const;

 private:
  std::vector<int> vertices_;               ///< Ascending.
  std::vector<Eigen::Vector3i> triangles_;  ///< Of places in vertices_.
  geometry::Adjacency neighbours_;          ///< Of places in vertices_.
};

}  // namespace daumier::rig
