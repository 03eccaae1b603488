#include "eval/baselines.h"

#include "core/error.h"
#include "eval/metrics.h"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace daumier::eval {
namespace {

/// Faces that are in memory at once: 256 faces of 34,000 coordinates in float64 are 70 MB.
constexpr int kBlock = 256;

FaceRows PointRows(const SketchSamples& samples, std::span<const int> faces) {
  FaceRows rows;
  for (size_t row = 0; row < faces.size(); ++row) {
    const std::vector<float> points = samples.curve_points(faces[row]);
    if (row == 0) rows.resize(Eigen::Index(faces.size()), Eigen::Index(points.size()));
    DAUMIER_CHECK(Eigen::Index(points.size()) == rows.cols(), "sketch {} has {} curve coordinates, others have {}",
                  faces[row], points.size(), rows.cols());
    rows.row(Eigen::Index(row)) = Eigen::Map<const Eigen::RowVectorXf>(points.data(), rows.cols());
  }
  return rows;
}

Eigen::Map<const Eigen::RowVectorXf> AsRow(std::span<const float> face) {
  return {face.data(), Eigen::Index(face.size())};
}

/// The coordinates of a region's vertices, picked from rows of whole faces.
Eigen::MatrixXd PickRegion(const Eigen::MatrixXd& coordinates, std::span<const int> region) {
  Eigen::MatrixXd picked(coordinates.rows(), 3 * Eigen::Index(region.size()));
  for (size_t i = 0; i < region.size(); ++i)
    picked.middleCols(3 * Eigen::Index(i), 3) = coordinates.middleCols(3 * Eigen::Index(region[i]), 3);
  return picked;
}

}  // namespace

Eigen::VectorXf MeanFace(const SketchSamples& samples, std::span<const int> train) {
  DAUMIER_CHECK(!train.empty(), "a mean face needs training faces");
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(Eigen::Index(samples.vertices(train[0]).size()));
  for (const int face : train) sum += AsRow(samples.vertices(face)).cast<double>();
  return (sum / double(train.size())).transpose().cast<float>();
}

NearestNeighbour::NearestNeighbour(const SketchSamples& samples, std::span<const int> train)
    : train_(train.begin(), train.end()), points_(PointRows(samples, train)) {
  DAUMIER_CHECK(!train_.empty(), "a nearest neighbour needs training faces");
}

int NearestNeighbour::Nearest(std::span<const float> curve_points) const {
  DAUMIER_CHECK(Eigen::Index(curve_points.size()) == points_.cols(), "the sketch has {} curve coordinates, expected {}",
                curve_points.size(), points_.cols());
  Eigen::Index best = 0;
  (points_.rowwise() - AsRow(curve_points)).rowwise().squaredNorm().minCoeff(&best);
  return train_[size_t(best)];
}

std::vector<double> DefaultRidgeLambdas() {
  return {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1e0, 1e1};
}

FaceRows RidgeRegression::Predict(const FaceRows& curve_points) const {
  DAUMIER_CHECK(curve_points.cols() == point_mean.size(), "the sketches have {} curve coordinates, expected {}",
                curve_points.cols(), point_mean.size());
  const FaceRows standardised =
      ((curve_points.rowwise() - point_mean).array().rowwise() * point_scale.array()).matrix();
  return (standardised * weights).rowwise() + mean_face;
}

RidgeFit FitRidge(const SketchSamples& samples, std::span<const int> train, std::span<const int> validation,
                  std::span<const int> region, std::span<const double> lambdas) {
  DAUMIER_CHECK(!train.empty() && !validation.empty() && !region.empty() && !lambdas.empty(),
                "ridge regression needs training faces, validation faces, a region and lambdas");
  RidgeFit fit;
  RidgeRegression& model = fit.model;
  const double num_train = double(train.size());
  model.mean_face = MeanFace(samples, train).transpose();
  const Eigen::Index num_coordinates = model.mean_face.size();

  const FaceRows points = PointRows(samples, train);
  const Eigen::RowVectorXd point_mean = points.cast<double>().colwise().mean();
  const Eigen::RowVectorXd deviation =
      ((points.cast<double>().rowwise() - point_mean).array().square().colwise().sum() / num_train).sqrt();
  model.point_mean = point_mean.cast<float>();
  model.point_scale = deviation.unaryExpr([](double d) { return d > 1e-6 ? 1 / d : 0.0; }).cast<float>();
  const auto standardise = [&](const FaceRows& rows) -> Eigen::MatrixXd {
    return ((rows.rowwise() - model.point_mean).array().rowwise() * model.point_scale.array()).matrix().cast<double>();
  };

  // Z^T Z / N and Z^T Y / N, block by block.
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(points.cols(), points.cols());
  Eigen::MatrixXd cross = Eigen::MatrixXd::Zero(points.cols(), num_coordinates);
  for (Eigen::Index begin = 0; begin < points.rows(); begin += kBlock) {
    const Eigen::Index count = std::min<Eigen::Index>(kBlock, points.rows() - begin);
    const Eigen::MatrixXd block = standardise(points.middleRows(begin, count));
    Eigen::MatrixXd faces(count, num_coordinates);
    for (Eigen::Index row = 0; row < count; ++row)
      faces.row(row) = (AsRow(samples.vertices(train[size_t(begin + row)])) - model.mean_face).cast<double>();
    gram.noalias() += block.transpose() * block;
    cross.noalias() += block.transpose() * faces;
  }
  gram /= num_train;
  cross /= num_train;

  // (G + lambda)^-1 = Q (L + lambda)^-1 Q^T for every lambda at once.
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(gram);
  const Eigen::ArrayXd eigenvalues = eigen.eigenvalues().array().max(0);
  const Eigen::MatrixXd rotated_cross = eigen.eigenvectors().transpose() * cross;

  const Eigen::MatrixXd validation_points = standardise(PointRows(samples, validation)) * eigen.eigenvectors();
  const Eigen::MatrixXd region_cross = PickRegion(rotated_cross, region);
  const Eigen::RowVectorXd region_mean = PickRegion(model.mean_face.cast<double>(), region);
  size_t best = 0;
  for (size_t i = 0; i < lambdas.size(); ++i) {
    const Eigen::MatrixXd scaled = ((eigenvalues + lambdas[i]).inverse().matrix().asDiagonal() * region_cross).eval();
    const FaceRows predicted = ((validation_points * scaled).rowwise() + region_mean).cast<float>();
    double sum = 0;
    for (size_t row = 0; row < validation.size(); ++row) {
      const std::span<const float> face = samples.vertices(validation[row]);
      for (size_t k = 0; k < region.size(); ++k) {
        const Eigen::Map<const Eigen::RowVector3f> truth(face.data() + 3 * region[k]);
        sum += double((predicted.block<1, 3>(Eigen::Index(row), 3 * Eigen::Index(k)) - truth).norm());
      }
    }
    fit.validation_errors.push_back(sum / double(validation.size() * region.size()));
    if (fit.validation_errors[i] < fit.validation_errors[best]) best = i;
  }
  fit.lambda = lambdas[best];
  model.weights = (eigen.eigenvectors() * ((eigenvalues + fit.lambda).inverse().matrix().asDiagonal() * rotated_cross))
                      .cast<float>();
  return fit;
}

}  // namespace daumier::eval
