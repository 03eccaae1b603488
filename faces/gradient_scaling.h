#pragma once
#include "geometry/poisson.h"
#include "geometry/topology.h"

#include <vector>

namespace daumier::faces {

/// V: `inside` at the vertices, 1 from blend_rings + 1 edges away on, linear between.
Eigen::VectorXd Fade(const geometry::Adjacency& neighbours, const std::vector<int>& vertices, double inside,
                     int blend_rings);

/// Rebuilds a surface from the scaled gradients of its coordinates [Yu et al. 2004; Sela et al. 2015]: the x' with
///   L x'_k = div(w_k grad x_k)  for each coordinate k,
/// L the clamped cotangent Laplacian, w_k in a triangle the mean of exp(log_scales(v, k)) over its corners v, and some
/// vertices fixed.
/// Promises: log scales of 0 return the surface; the same constant everywhere scales it about what is fixed, if that is
/// one vertex.
class GradientScaling {
 public:
  /// @throws Error as PoissonSolver, or on a triangle without area.
  GradientScaling(const geometry::TriangleMesh& mesh, const std::vector<int>& fixed);

  /// log_scales: V x 3, a column a coordinate. @throws Error if the shape disagrees.
  geometry::Points Rebuild(const geometry::Points& log_scales) const;

  /// Rebuild; where a triangle's normal would turn by more than 90 degrees, the log scales are halved around it and the
  /// surface rebuilt, again and again over ever more rings (multiples of blend_rings), at most 12 times.
  geometry::Points RebuildWithoutFlips(geometry::Points log_scales, int blend_rings) const;

  const geometry::Adjacency& neighbours() const { return neighbours_; }

 private:
  geometry::TriangleMesh mesh_;
  geometry::Adjacency neighbours_;
  geometry::Points cotangents_;
  geometry::PoissonSolver solver_;
  geometry::Points fixed_points_;
};

}  // namespace daumier::faces
