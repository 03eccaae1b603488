#pragma once
#include "eval/face_rows.h"

#include <Eigen/Core>

#include <functional>
#include <span>
#include <vector>

/// Predictors that cost nothing: what a network has to beat. All are fitted on the faces named as training faces and
/// read no other; the ridge's one constant is chosen on validation faces.
namespace daumier::eval {

/// Where the baselines read, face by face.
struct SketchSamples {
  std::function<std::span<const float>(int face)> vertices;  ///< 3V coordinates in cm.
  std::function<std::vector<float>(int face)> curve_points;  ///< 2P coordinates on the sketch canvas.
};

/// Curve points, row a face. @throws Error if two faces have not the same number.
FaceRows PointRows(const SketchSamples& samples, std::span<const int> faces);

/// The mean of the training faces, 3V.
Eigen::VectorXf MeanFace(const SketchSamples& samples, std::span<const int> train);

/// The training face whose curve points are nearest in the plane (sum of squares; the first of equals).
class NearestNeighbour {
 public:
  NearestNeighbour(const SketchSamples& samples, std::span<const int> train);
  /// The index of a training face. @throws Error if the number of points differs.
  int Nearest(std::span<const float> curve_points) const;

 private:
  std::vector<int> train_;
  FaceRows points_;
};

/// Ridge regression of the vertices on the curve points:
///   face = mean + B^T z,  z = (x - mean_x) / deviation_x,  B = argmin sum_n ||g_n - mean - B^T z_n||^2 + lambda N
///   ||B||^2.
/// Points that never move in training are left out.
struct RidgeRegression {
  Eigen::RowVectorXf point_mean, point_scale;  ///< 2P; scale is 1 / deviation, 0 for a point that never moves.
  Eigen::RowVectorXf mean_face;                ///< 3V
  FaceRows weights;                            ///< B, 2P x 3V

  /// num_faces x 3V, from num_faces x 2P curve points. @throws Error if the number of points differs.
  FaceRows Predict(const FaceRows& curve_points) const;
};

struct RidgeFit {
  RidgeRegression model;
  double lambda = 0;
  std::vector<double> validation_errors;  ///< Mean distance over `region` in cm on the validation faces, one a lambda.
};

/// Normal equations in float64, summed over blocks of training faces; one eigendecomposition serves every lambda. All
/// large products are LibTorch's.
/// Lambda is the one with the least mean vertex distance over `region` on the validation faces. @throws Error if a list
/// is empty.
RidgeFit FitRidge(const SketchSamples& samples, std::span<const int> train, std::span<const int> validation,
                  std::span<const int> region, std::span<const double> lambdas);

/// 1e-6, 1e-5, ... 1e1: relative to standardised points.
std::vector<double> DefaultRidgeLambdas();

}  // namespace daumier::eval
