#pragma once
#include "rig/morph_targets.h"

#include <vector>

#include <Eigen/Core>

namespace daumier::rig {

/// How far weighted targets are from a displacement: over vertices v of mass m_v > 0,
///   rms^2 = sum_v m_v |sum_t w_t o_tv - d_v|^2 / sum_v m_v,
/// and the greatest length.
struct DisplacementError {
  double rms_cm = 0, greatest_cm = 0;
};

/// Whether eyeLook*, which turn the eyes, may be used: other displacements of lids look like theirs.
enum class GazeTargets { kUsed, kZero };
/// Upper bounds of the 52 weights: `most`, 0 of tongueOut, which no skin shows, and of eyeLook* unless they are used.
Eigen::VectorXd MostWeights(double most, GazeTargets gaze);

/// Weights of the 52 targets of a head that come nearest to a displacement of its vertices:
///   argmin_w sum_v m_v |sum_t w_t o_tv - d_v|^2,  0 <= w_t <= most_t,  w_mouthClose <= w_jawOpen,
/// the last because mouthClose alone is no expression (WeightLimits). An upper bound of jawOpen is kept by lowering
/// both of them. const and thread-safe.
class WeightSolver {
 public:
  /// targets: of ArkitNames() in their order, 3V x 52, cm. masses: V, not negative: areas. most: 52, infinity for none; 0 for
  /// targets that stay 0. @throws Error if a shape disagrees, or if no vertex has a mass.
  WeightSolver(const MorphTargets& targets, const Eigen::VectorXd& masses, const Eigen::VectorXd& most);

  /// displacement: 3V, cm. @throws Error if it has another size, or is not finite.
  Eigen::VectorXd Solve(const Eigen::VectorXd& displacement) const;

  /// Weights, and coefficients x of further displacements without bounds (columns of `motions`, 3V x M, independent): the
  /// displacement is sum_t w_t o_t + sum_m x_m motion_m.
  struct WithMotions {
    Eigen::VectorXd weights;  ///< 52
    Eigen::VectorXd motions;  ///< M
  };
  WithMotions Solve(const Eigen::VectorXd& displacement, const Eigen::MatrixXd& motions) const;

  /// Of weights, 52; of none: the displacement itself. @throws Error as Solve.
  DisplacementError ErrorOf(const Eigen::VectorXd& displacement, const Eigen::VectorXd& weights) const;

  /// sum_t w_t o_t, 3V; 0 at vertices without mass.
  Eigen::VectorXd Displacement(const Eigen::VectorXd& weights) const;

  Eigen::Index num_vertices() const { return num_vertices_; }
  /// Vertices with mass, ascending, and the mass of each.
  const std::vector<Eigen::Index>& vertices() const { return vertices_; }
  const Eigen::VectorXd& masses() const { return masses_; }

 private:
  Eigen::MatrixXd Weighted(const Eigen::Ref<const Eigen::MatrixXd>& columns) const;
  Eigen::VectorXd Bounded(const Eigen::MatrixXd& gram, const Eigen::VectorXd& right) const;

  Eigen::Index num_vertices_ = 0;
  std::vector<Eigen::Index> vertices_;
  Eigen::VectorXd masses_, most_;
  Eigen::MatrixXd rows_;  ///< sqrt(m_v) o_tv of the vertices with mass, 3 rows each.
  Eigen::MatrixXd gram_;
};

}  // namespace daumier::rig
