#include "eval/ridge_regression.h"

#include "eval/metrics.h"
#include "geometry/symmetric_eigen.h"

#include <algorithm>

namespace daumier::eval {
namespace {

using DoubleRows = RowMajorMatrix<double>;

/// Faces that are in memory at once: 256 faces of 34,000 coordinates in float64 are 70 MB.
constexpr size_t kBlock = 256;

/// The columns of a region's vertices, 3 each.
std::vector<Eigen::Index> Coordinates(std::span<const int> region, Eigen::Index num_coordinates) {
  std::vector<Eigen::Index> columns;
  for (const int vertex : region) {
    DAUMIER_CHECK(vertex >= 0 && 3 * Eigen::Index(vertex) + 3 <= num_coordinates,
                  "the region has vertex {}, the face {} vertices", vertex, num_coordinates / 3);
    for (int axis = 0; axis < 3; ++axis) columns.push_back(3 * Eigen::Index(vertex) + axis);
  }
  return columns;
}

}  // namespace

std::vector<double> DefaultRidgeLambdas() {
  return {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1e0, 1e1};
}

FaceRows RidgeRegression::Predict(const FaceRows& curve_points) const {
  DAUMIER_CHECK(curve_points.cols() == point_mean.size(), "the sketches have {} curve coordinates, expected {}",
                curve_points.cols(), point_mean.size());
  const FaceRows standardised = (curve_points.rowwise() - point_mean) * point_scale.asDiagonal();
  FaceRows faces = Product(standardised, weights);
  faces.rowwise() += mean_face;
  return faces;
}

RidgeFit FitRidge(const SketchSamples& samples, std::span<const int> train, std::span<const int> validation,
                  std::span<const int> region, std::span<const double> lambdas) {
  DAUMIER_CHECK(!train.empty() && !validation.empty() && !region.empty() && !lambdas.empty(),
                "ridge regression needs training faces, validation faces, a region and lambdas");
  RidgeFit fit;
  RidgeRegression& model = fit.model;
  const double num_train = double(train.size());
  model.mean_face = MeanFace(samples.vertices, train);
  const std::vector<Eigen::Index> region_columns = Coordinates(region, model.mean_face.size());

  const FaceRows points = ReadRows(samples.curve_points, train);
  const Eigen::RowVectorXd point_mean = points.cast<double>().colwise().mean();
  const Eigen::RowVectorXd deviation =
      ((points.cast<double>().rowwise() - point_mean).array().square().colwise().sum() / num_train).sqrt();
  model.point_mean = point_mean.cast<float>();
  model.point_scale = deviation.unaryExpr([](double d) { return d > 1e-6 ? 1 / d : 0.0; }).cast<float>();
  const auto standardise = [&](const FaceRows& rows) -> DoubleRows {
    return ((rows.rowwise() - model.point_mean) * model.point_scale.asDiagonal()).cast<double>();
  };

  // Z^T Z / N and Z^T Y / N, the latter block by block.
  const DoubleRows z = standardise(points);
  DoubleRows cross = DoubleRows::Zero(z.cols(), model.mean_face.size());
  for (size_t begin = 0; begin < train.size(); begin += kBlock) {
    const std::span<const int> block = train.subspan(begin, std::min(kBlock, train.size() - begin));
    const DoubleRows y = ReadRows(samples.vertices, block).cast<double>().rowwise() - model.mean_face.cast<double>();
    AddProduct(1 / num_train, z.middleRows(Eigen::Index(begin), y.rows()).transpose(), y, cross);
  }
  const geometry::SymmetricEigen eigen = geometry::DecomposeSymmetric(Product(z.transpose(), z) / num_train);
  const Eigen::MatrixXd& vectors = eigen.vectors;
  const Eigen::ArrayXd eigenvalues = eigen.values.cwiseMax(0);

  // (G + lambda)^-1 = Q (L + lambda)^-1 Q^T for every lambda at once.
  const DoubleRows rotated_cross = Product(vectors.transpose(), cross);
  const FaceRows region_cross = rotated_cross(Eigen::all, region_columns).cast<float>();
  const FaceRows truth =
      (ReadRows(samples.vertices, validation).rowwise() - model.mean_face)(Eigen::all, region_columns);
  const DoubleRows validation_points = Product(standardise(ReadRows(samples.curve_points, validation)), vectors);
  size_t best = 0;
  for (size_t i = 0; i < lambdas.size(); ++i) {
    const FaceRows scaled =
        (validation_points * (eigenvalues + lambdas[i]).inverse().matrix().asDiagonal()).cast<float>();
    fit.validation_errors.push_back(MeanVertexDistance(Product(scaled, region_cross), truth));
    if (fit.validation_errors[i] < fit.validation_errors[best]) best = i;
  }
  fit.lambda = lambdas[best];
  const Eigen::MatrixXd inverse = vectors * (eigenvalues + fit.lambda).inverse().matrix().asDiagonal();
  model.weights = Product(inverse, rotated_cross).cast<float>();
  return fit;
}

}  // namespace daumier::eval
