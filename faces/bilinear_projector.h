#pragma once
#include "faces/bilinear_model.h"

#include <Eigen/Cholesky>

#include <span>
#include <vector>

namespace daumier::faces {

struct BilinearProjection {
  Eigen::VectorXf u, v;
  Eigen::VectorXf vertices;  ///< Reconstruct(model, u, v)
};

/// The u and v nearest to a face in the least-squares sense over `weights` (3V, >= 0, or empty for ones), by
/// Gauss-Newton from the fitted expression whose start is best. The free scale between u and v is set so that v is as
/// long as that expression and points to its side. Keeps G = C W C^T, so that one projection costs no product with the
/// core beyond C W g. Keeps a reference to `model`. @throws Error if the weights or a face have another size.
class BilinearProjector {
 public:
  explicit BilinearProjector(const BilinearModel& model, const Eigen::VectorXf& coordinate_weights = {});
  BilinearProjection Project(std::span<const float> face) const;

 private:
  Eigen::MatrixXd IdentityGram(const Eigen::VectorXd& v) const;
  Eigen::MatrixXd HalfExpressionGram(const Eigen::VectorXd& u) const;

  const BilinearModel* model_;
  Eigen::VectorXd weights_;
  Eigen::MatrixXd gram_;
  std::vector<Eigen::LDLT<Eigen::MatrixXd>> starts_;  ///< Of IdentityGram(v), one a fitted expression.
};

}  // namespace daumier::faces
