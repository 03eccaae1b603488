#include "geometry/alignment.h"

#include "core/error.h"

#include <Eigen/LU>
#include <Eigen/SVD>

#include <cmath>

namespace daumier::geometry {

Points Similarity::Apply(const Points& points) const {
  return (scale * points * rotation.transpose()).rowwise() + translation.transpose();
}

Similarity AlignSimilarity(const Points& source, const Points& target, const Eigen::VectorXd& weights) {
  DAUMIER_CHECK(source.rows() == target.rows(), "{} source points for {} target points", source.rows(), target.rows());
  DAUMIER_CHECK(weights.size() == 0 || weights.size() == source.rows(), "{} weights for {} points", weights.size(),
                source.rows());
  const Eigen::VectorXd w = weights.size() ? weights : Eigen::VectorXd::Ones(source.rows());
  const double total = w.sum();
  DAUMIER_CHECK(total > 0 && w.minCoeff() >= 0, "alignment needs weights that are not negative and not all zero");
  const Eigen::RowVector3d source_centre = w.transpose() * source / total,
                           target_centre = w.transpose() * target / total;
  const Points p = source.rowwise() - source_centre, q = target.rowwise() - target_centre;
  const Eigen::Matrix3d source_moments = p.transpose() * w.asDiagonal() * p / total;
  const Eigen::Matrix3d covariance = q.transpose() * w.asDiagonal() * p / total;
  const Eigen::Vector3d spread = source_moments.jacobiSvd().singularValues();
  DAUMIER_CHECK(spread[1] > 1e-12 * spread[0], "the source points lie in one line: the rotation is not determined");

  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  DAUMIER_CHECK(svd.singularValues()[0] > 0, "the target points lie in one point");
  Eigen::Vector3d sign = Eigen::Vector3d::Ones();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0) sign[2] = -1;
  Similarity similarity;
  similarity.rotation = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
  similarity.scale = svd.singularValues().dot(sign) / source_moments.trace();
  similarity.translation =
      target_centre.transpose() - similarity.scale * similarity.rotation * source_centre.transpose();
  return similarity;
}

Similarity AlignRobustly(const Points& source, const Points& target, const Eigen::VectorXd& weights) {
  constexpr int kIterations = 30;
  constexpr double kLeastShare = 1e-3;  // Of the target's size: closer points weigh as much as at this distance.
  Similarity similarity = AlignSimilarity(source, target, weights);
  const Eigen::VectorXd w = weights.size() ? weights : Eigen::VectorXd::Ones(source.rows());
  const Eigen::RowVector3d centre = w.transpose() * target / w.sum();
  const double floor = kLeastShare * std::sqrt(w.dot((target.rowwise() - centre).rowwise().squaredNorm()) / w.sum());
  for (int i = 0; i < kIterations; ++i) {
    const Eigen::ArrayXd distances = (similarity.Apply(source) - target).rowwise().norm();
    similarity = AlignSimilarity(source, target, (w.array() / distances.max(floor)).matrix());
  }
  return similarity;
}

Similarity Inverse(const Similarity& similarity) {
  Similarity inverse;
  inverse.scale = 1 / similarity.scale;
  inverse.rotation = similarity.rotation.transpose();
  inverse.translation = -inverse.scale * (inverse.rotation * similarity.translation);
  return inverse;
}

}  // namespace daumier::geometry
