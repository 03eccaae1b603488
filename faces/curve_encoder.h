#pragma once
#include "core/options.h"
#include "faces/bilinear_model.h"
#include "faces/coefficient_prior.h"

#include <span>
#include <vector>

namespace daumier::faces {

struct CurveEncoderOptions {
  double deviation_px = 0.5;
  int rounds = 4;

  template <class V>
  void Visit(V&& visit) {
    visit(
        "deviation_px", deviation_px, Range{1e-3, 100},
        "Standard deviation of drawn points from the model, pixels; the larger, the more the prior of u and v counts.");
    visit("rounds", rounds, Range{1, 100}, "Alternations between u and v.");
  }
};

struct CurveCode {
  Eigen::VectorXf u, v;
  Eigen::VectorXf points;  ///< 2K, what the model makes of u and v.

  /// u, then v: the shape-level input of a network, 66 numbers with the paper's 50 and 16.
  Eigen::VectorXf numbers() const;
};

/// The shape-level input [Han et al. 2017, section 4.3]: u and v of the bilinear model of 2-D curve points that explain
/// drawn points best, some of which may be missing:
///   min  sum_k w_k |C_k x2 u x3 v - p_k|^2 / deviation^2 + sum_i ((u_i - mean) / sigma)_i^2 + the same of v,
/// with the means and standard deviations of a prior, and w in [0, 1]. Alternating least squares; the prior says what
/// the points do not, and settles the free scale between u and v.
class CurveEncoder {
 public:
  /// With the prior of the fitted identities and expressions, PriorOf. Keeps a reference to the model.
  explicit CurveEncoder(const BilinearModel& model, const CurveEncoderOptions& options = {});
  /// With another prior. @throws Error if it has other lengths.
  CurveEncoder(const BilinearModel& model, const CoefficientPrior& prior, const CurveEncoderOptions& options = {});

  /// points: 2K (x0 y0 x1 ...); weights: K. Points of weight 0 are ignored. 300 points or more are subsampled by 2, 3,
  /// ..., each with that weight. Starts from `start` where one is given, otherwise from the prior's means. @throws
  /// Error if a number of points differs.
  CurveCode Encode(std::span<const float> points, std::span<const float> weights,
                   const CurveCode* start = nullptr) const;

  int num_points() const { return model_->num_coordinates() / 2; }
  /// Length of CurveCode::numbers().
  int num_numbers() const { return model_->num_identity + model_->num_expression; }

 private:
  const BilinearModel* model_;
  CurveEncoderOptions options_;
  CoefficientPrior prior_;
};

}  // namespace daumier::faces
