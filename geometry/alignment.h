#pragma once
#include "geometry/mesh.h"

namespace daumier::geometry {

/// x -> scale * rotation * x + translation.
struct Similarity {
  double scale = 1;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Vector3 translation = Vector3::Zero();

  Points Apply(const Points& points) const;
};
/// The similarity that undoes one. Its scale must not be 0.
Similarity Inverse(const Similarity& similarity);

/// The similarity that minimises sum_i w_i |scale R source_i + t - target_i|^2 [Umeyama 1991]; R is a rotation, never a
/// reflection. `weights` (V, not negative) may be empty for ones.
/// @throws Error if a shape disagrees, a weight is negative, the weighted source lies in one line (the rotation is then
/// undetermined), or the weighted target in one point.
Similarity AlignSimilarity(const Points& source, const Points& target, const Eigen::VectorXd& weights = {});

/// The similarity that minimises the weighted sum of distances sum_i w_i |scale R source_i + t - target_i|, by iterated
/// reweighting of AlignSimilarity: a few points that are far off hardly move it. @throws Error as AlignSimilarity.
Similarity AlignRobustly(const Points& source, const Points& target, const Eigen::VectorXd& weights = {});

}  // namespace daumier::geometry
