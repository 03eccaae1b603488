#include "eval/baselines.h"

#include "core/error.h"
#include "eval/metrics.h"
#include "tensor/eigen.h"
#include "tensor/torch_version.h"

#include <ATen/ops/linalg_eigh.h>
#include <torch/types.h>

#include <algorithm>
#include <cmath>

namespace daumier::eval {
namespace {

/// Faces that are in memory at once: 256 faces of 34,000 coordinates in float64 are 70 MB.
constexpr int kBlock = 256;

Eigen::Map<const Eigen::RowVectorXf> AsRow(std::span<const float> face) {
  return {face.data(), Eigen::Index(face.size())};
}

/// Coordinates of faces, a row a face.
torch::Tensor FaceTensor(const SketchSamples& samples, std::span<const int> faces, torch::ScalarType type) {
  const auto num_coordinates = int64_t(samples.vertices(faces[0]).size());
  torch::Tensor rows = torch::empty({int64_t(faces.size()), num_coordinates}, torch::kFloat32);
  for (size_t row = 0; row < faces.size(); ++row) {
    const std::span<const float> face = samples.vertices(faces[row]);
    std::copy(face.begin(), face.end(), rows.data_ptr<float>() + int64_t(row) * num_coordinates);
  }
  return rows.to(type);
}

/// Of the coordinates of a region's vertices.
torch::Tensor CoordinateIndex(std::span<const int> region) {
  std::vector<int64_t> index;
  for (const int vertex : region)
    for (int axis = 0; axis < 3; ++axis) index.push_back(3 * int64_t(vertex) + axis);
  return torch::tensor(index);
}

}  // namespace

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
  const torch::Tensor product = torch::mm(tensor::CopyToTensor(standardised), tensor::CopyToTensor(weights));
  return tensor::ViewAsMatrix<float>(product).rowwise() + mean_face;
}

RidgeFit FitRidge(const SketchSamples& samples, std::span<const int> train, std::span<const int> validation,
                  std::span<const int> region, std::span<const double> lambdas) {
  DAUMIER_CHECK(!train.empty() && !validation.empty() && !region.empty() && !lambdas.empty(),
                "ridge regression needs training faces, validation faces, a region and lambdas");
  RidgeFit fit;
  RidgeRegression& model = fit.model;
  const double num_train = double(train.size());
  model.mean_face = MeanFace(samples, train).transpose();

  const FaceRows points = PointRows(samples, train);
  const Eigen::RowVectorXd point_mean = points.cast<double>().colwise().mean();
  const Eigen::RowVectorXd deviation =
      ((points.cast<double>().rowwise() - point_mean).array().square().colwise().sum() / num_train).sqrt();
  model.point_mean = point_mean.cast<float>();
  model.point_scale = deviation.unaryExpr([](double d) { return d > 1e-6 ? 1 / d : 0.0; }).cast<float>();
  const auto standardise = [&](const FaceRows& rows) {
    return tensor::CopyToTensor(((rows.rowwise() - model.point_mean).array().rowwise() * model.point_scale.array()))
        .to(torch::kFloat64);
  };

  // Z^T Z / N and Z^T Y / N, the latter block by block.
  const at::NoGradGuard no_grad;
  const torch::Tensor z = standardise(points), mean_face = tensor::CopyToTensor(model.mean_face).to(torch::kFloat64);
  const torch::Tensor gram = torch::mm(z.t(), z) / num_train;
  torch::Tensor cross = torch::zeros({z.size(1), model.mean_face.size()}, torch::kFloat64);
  for (size_t begin = 0; begin < train.size(); begin += kBlock) {
    const std::span<const int> block = train.subspan(begin, std::min<size_t>(kBlock, train.size() - begin));
    const torch::Tensor y = FaceTensor(samples, block, torch::kFloat64) - mean_face;
    cross.addmm_(z.slice(0, int64_t(begin), int64_t(begin + block.size())).t(), y, 1, 1 / num_train);
  }

  // (G + lambda)^-1 = Q (L + lambda)^-1 Q^T for every lambda at once.
  const auto [values, vectors] = at::linalg_eigh(gram, "L");
  const torch::Tensor eigenvalues = values.clamp_min(0), rotated_cross = torch::mm(vectors.t(), cross);
  const torch::Tensor index = CoordinateIndex(region);
  const torch::Tensor region_cross = rotated_cross.index_select(1, index).to(torch::kFloat32),
                      truth = (FaceTensor(samples, validation, torch::kFloat32) - mean_face.to(torch::kFloat32))
                                  .index_select(1, index),
                      validation_points = torch::mm(standardise(PointRows(samples, validation)), vectors);
  size_t best = 0;
  for (size_t i = 0; i < lambdas.size(); ++i) {
    const torch::Tensor scaled = (validation_points / (eigenvalues + lambdas[i])).to(torch::kFloat32);
    const torch::Tensor difference = torch::mm(scaled, region_cross) - truth;
    fit.validation_errors.push_back(
        difference.view({difference.size(0), -1, 3}).norm(2, 2).mean(torch::kFloat64).item<double>());
    if (fit.validation_errors[i] < fit.validation_errors[best]) best = i;
  }
  fit.lambda = lambdas[best];
  model.weights = tensor::CopyToMatrix<float>(torch::mm(vectors / (eigenvalues + fit.lambda), rotated_cross));
  return fit;
}

}  // namespace daumier::eval
