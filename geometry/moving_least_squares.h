#pragma once
#include <Eigen/Core>

#include <vector>

namespace daumier::geometry {

/// The maps of the plane that a moving least-squares deformation is made of.
enum class PlanarMap { kSimilarity, kRigid };

/// Deformation of the plane by handles [Schaefer et al. 2006]: v goes to l_v(v), where l_v is the similarity, or the
/// rotation with translation, that minimises sum_i w_i |l_v(p_i) - q_i|^2 with w_i = 1 / (|p_i - v|^4 + 1e-8), p_i the
/// handles, q_i their targets. In the units of the handles, 1e-8 is a hundredth to the fourth: meant for pixels.
///
/// Handles go to their targets, but for about 1e-8 / d^3, d the distance to the next handle. Where the targets are a
/// similarity (a rigid motion) of the handles, all points follow it. Far from all handles a rigid map moves rigidly.
/// Handles in one point act as one that goes to the mean of their targets and weighs as much as they. A handle alone
/// translates; without handles nothing moves.
class MovingLeastSquares {
 public:
  /// @throws Error if there are more or fewer targets than handles.
  MovingLeastSquares(const std::vector<Eigen::Vector2d>& handles, const std::vector<Eigen::Vector2d>& targets,
                     PlanarMap kind);

  Eigen::Vector2d Apply(const Eigen::Vector2d& point) const;

 private:
  struct Handle {
    Eigen::Vector2d position, target;
    double multiplicity = 1;
  };

  std::vector<Handle> handles_;  ///< No two in one point.
  PlanarMap kind_;
};

}  // namespace daumier::geometry
