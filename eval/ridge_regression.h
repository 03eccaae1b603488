#pragma once
#include "eval/face_rows.h"

#include <functional>
#include <span>
#include <vector>

namespace daumier::eval {

/// Where a regression reads sketches and faces, face by face.
struct SketchSamples {
  FaceReader vertices;                                       ///< 3V coordinates in cm.
  std::function<std::vector<float>(int face)> curve_points;  ///< 2P coordinates on the sketch canvas.
};

/// Ridge regression of the vertices on the curve points:
///   face = mean + B^T z,  z = (x - mean_x) / deviation_x,
///   B = argmin sum_n ||g_n - mean - B^T z_n||^2 + lambda N ||B||^2.
/// Points that never move in training are ignored.
struct RidgeRegression {
  Eigen::RowVectorXf point_mean, point_scale;  ///< 2P; scale is 1 / deviation, 0 for a point that never moves.
  Eigen::RowVectorXf mean_face;                ///< 3V
  FaceRows weights;                            ///< B, 2P x 3V

  /// num_faces x 3V, from num_faces x 2P curve points. May be called from several threads.
  /// @throws Error if the number of points differs.
  FaceRows Predict(const FaceRows& curve_points) const;
};

struct RidgeFit {
  RidgeRegression model;
  double lambda = 0;
  std::vector<double> validation_errors;  ///< Mean distance over `region` in cm on the validation faces, one a lambda.
};

/// Normal equations in float64, summed over blocks of training faces; one eigendecomposition serves every lambda.
/// Lambda is the one with the least mean vertex distance over `region` on the validation faces. Reads no other face.
/// @throws Error if a list is empty, or the region has a vertex that the faces do not have.
RidgeFit FitRidge(const SketchSamples& samples, std::span<const int> train, std::span<const int> validation,
                  std::span<const int> region, std::span<const double> lambdas);

/// 1e-6, 1e-5, ... 1e1: relative to standardised points.
std::vector<double> DefaultRidgeLambdas();

}  // namespace daumier::eval
