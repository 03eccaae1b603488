#pragma once
#include "faces/morphable_model.h"
#include "fitting/portrait_view.h"

#include <Eigen/Core>

namespace daumier::fitting {

enum class PortraitFreedom {
  kPose,         ///< The mean face in its best pose.
  kPoseAndFace,  ///< Pose, identity and expression.
};

struct PortraitFitOptions {
  PortraitFreedom freedom = PortraitFreedom::kPoseAndFace;
  double deviation_px = 1;            ///< Of landmarks from the model, pixels; the larger, the more the priors count.
  double identity_deviation = 1;      ///< Of identity weights; 1 is the model's own prior.
  double expression_deviation = 0.5;  ///< Of expression weights of kUnit from 0; those of kStandardNormal have 1.
  int iterations = 50;                ///< Steps of the solver at most, of each start.
  bool about_start = false;           ///< Of AdjustPortrait: the priors are about the given coefficients, not about 0.
};

struct PortraitFit {
  Eigen::VectorXf coefficients;  ///< 239: identity, expression and pose; albedo and light are 0.
  double rms_px = 0;             ///< Weighted root mean square distance of the landmarks.
  PortraitPose pose() const { return coefficients.tail<6>().cast<double>(); }
};

/// The 68 landmarks of a 3DMM: what a fit to landmarks needs of it.
class LandmarkModel {
 public:
  explicit LandmarkModel(const faces::MorphableModel& model);

  int num_identity() const { return int(identity_.cols()); }
  int num_expression() const { return int(expression_.cols()); }
  faces::ExpressionWeights expression_weights() const { return expression_weights_; }
  /// 68 x 3, cm.
  geometry::Points Landmarks(const Eigen::VectorXd& identity, const Eigen::VectorXd& expression) const;

  /// Pixels of the landmarks, 2L (x0 y0 x1 ...), and their derivatives: a row a number, a column a coefficient.
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  struct Value {
    Eigen::VectorXd pixels;
    Rows by_pose, by_identity, by_expression;
  };
  Value At(const PortraitPose& pose, const Eigen::VectorXd& identity, const Eigen::VectorXd& expression,
           const PortraitView& view = {}) const;

 private:
  geometry::Points mean_;
  Eigen::MatrixXd identity_, expression_;  ///< 204 x S, 204 x E
  faces::ExpressionWeights expression_weights_;
};

/// Landmark fit of a 3DMM to one picture [Pan et al. 2024, eq. 7], squared and with the model's priors:
///   min sum_n w_n |Pi(R p_n + t) - q_n|^2 / deviation^2 + |a_id / sigma_id|^2 + |a_exp / sigma_exp|^2
/// over pose, identity and expression (Levenberg-Marquardt; weights of kUnit stay in 0 .. 1). The pose alone is found
/// first, from the yaws -40, 0 and 40 degrees. landmarks: 68 x 2; weights: 68, >= 0; a landmark of weight 0 is ignored.
/// @throws Error if a size differs, a weight is negative, or fewer than four landmarks count.
PortraitFit FitPortrait(const LandmarkModel& model, const PicturePoints& landmarks, const Eigen::VectorXd& weights,
                        const PortraitFitOptions& options = {});

/// What of a coarse face a fit to landmarks adjusts.
enum class PortraitAdjustment { kPose, kExpression, kIdentityAndExpression, kAll };

/// Adjusts some coefficients of a known face [Pan et al. 2024, eq. 7 and 8: Adjust Exp, Adjust Id+Exp]: as FitPortrait,
/// from the given coefficients, of which all others stay. The pose has no prior.
/// coefficients: 239. @throws Error as FitPortrait, or if there are not 239.
PortraitFit AdjustPortrait(const LandmarkModel& model, const Eigen::VectorXf& coefficients,
                           const PicturePoints& landmarks, const Eigen::VectorXd& weights,
                           PortraitAdjustment adjustment, const PortraitFitOptions& options = {});

}  // namespace daumier::fitting
