#pragma once
#include "faces/bilinear_model.h"
#include "fitting/projected_curves.h"

#include <Eigen/Core>

#include <span>

namespace daumier::fitting {

struct MorphableFitOptions {
  bool prior = true;          ///< Whether u and v stay near those of the training faces.
  double deviation_px = 0.5;  ///< Of labelled points from the model, pixels; the larger, the more the prior counts.
  int iterations = 100;       ///< Steps of the solver at most.
};

struct MorphableFit {
  Eigen::VectorXf u, v;
  double rms_px = 0.0;  ///< Root mean square distance of the points that count, each weighted.
  int iterations = 0;
};

/// Morphable model fitting [Han et al. 2017, section 6.3, row MMfitting; Cao et al. 2014]: the face whose key vertices,
/// seen by a known orthographic camera, are nearest to their labelled 2-D points,
///   min  sum_k w_k |P_k(u, v) - p_k|^2 / deviation^2  [ + |(u - mean) / sigma|^2 + |(v - mean) / sigma|^2 ]
/// over u and v together (Levenberg-Marquardt), from the means of faces::PriorOf. The bracket applies with `prior`;
/// without it nothing is known of the depth, and the free scale between u and v is set so that v is as long as the
/// prior's mean. points: 2K in pixels; weights: K, >= 0; a point of weight 0 is ignored.
/// @throws Error if a number of points differs, a weight is negative, or no point counts.
MorphableFit FitMorphable(const ProjectedModel& model, std::span<const float> points, std::span<const float> weights,
                          const MorphableFitOptions& options = {});

/// The first sum of FitMorphable as residuals and their derivatives, in float64.
class KeyPointResiduals {
 public:
  /// @throws Error as FitMorphable.
  KeyPointResiduals(const ProjectedModel& model, std::span<const float> points, std::span<const float> weights,
                    double deviation_px);

  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  struct Value {
    Eigen::VectorXd residuals;  ///< Two a point that counts: sqrt(w_k) (P_k(u, v) - p_k) / deviation.
    Rows by_u, by_v;            ///< Their derivatives: a row a residual, a column a coefficient.
  };
  Value At(const Eigen::VectorXd& u, const Eigen::VectorXd& v) const;

  int num_residuals() const { return static_cast<int>(target_.size()); }
  double sum_of_weights() const { return sum_of_weights_; }

 private:
  int num_identity_, num_expression_;
  double sum_of_weights_ = 0.0;
  Rows core_;  ///< Columns of the points that count, each scaled by sqrt(w_k) / deviation, as is the target.
  Eigen::VectorXd target_;
};

}  // namespace daumier::fitting
