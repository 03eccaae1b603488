#include "faces/curve_encoder.h"

#include "core/error.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace daumier::faces {
namespace {

using CurveRows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Neighbouring points of a curve are redundant: where twice as many are visible, they are subsampled.
constexpr int kEnoughPoints = 150;

/// argmin_x |W (A^T x - points)|^2 / deviation_px^2 + |(x - mean) / deviation|^2; rows of `basis` are those of A,
/// already multiplied by the square roots W / deviation_px, as are the points.
Eigen::VectorXf SolveWithPrior(const CurveRows& basis, const Eigen::VectorXf& points, const Eigen::VectorXf& mean,
                               const Eigen::VectorXf& deviation) {
  // A rank update stays on its thread, where Eigen would share out a product; every core encodes a sketch of its own.
  Eigen::MatrixXf gram = Eigen::MatrixXf::Zero(basis.rows(), basis.rows());
  gram.selfadjointView<Eigen::Lower>().rankUpdate(basis);
  Eigen::MatrixXd normal = gram.cast<double>();
  const Eigen::VectorXd precision = deviation.cast<double>().cwiseAbs2().cwiseInverse();
  normal.diagonal() += precision;
  const Eigen::VectorXd right = (basis * points).cast<double>() + precision.cwiseProduct(mean.cast<double>());
  return normal.llt().solve(right).cast<float>();
}

}  // namespace

Eigen::VectorXf CurveCode::numbers() const {
  Eigen::VectorXf all(u.size() + v.size());
  all << u, v;
  return all;
}

CurveEncoder::CurveEncoder(const BilinearModel& model, const CurveEncoderOptions& options)
    : CurveEncoder(model, PriorOf(model), options) {}

CurveEncoder::CurveEncoder(const BilinearModel& model, const CoefficientPrior& prior,
                           const CurveEncoderOptions& options)
    : model_(&model), options_(options), prior_(prior) {
  DAUMIER_CHECK(prior.u_mean.size() == model.num_identity && prior.v_mean.size() == model.num_expression,
                "a prior of {} and {} numbers for a model of {} and {}", prior.u_mean.size(), prior.v_mean.size(),
                model.num_identity, model.num_expression);
}

CurveCode CurveEncoder::Encode(std::span<const float> points, std::span<const float> weights,
                               const CurveCode* start) const {
  const int num_identity = model_->num_identity, num_expression = model_->num_expression;
  DAUMIER_CHECK(int(points.size()) == 2 * num_points() && int(weights.size()) == num_points(),
                "{} coordinates and {} weights were given for the {} points of a curve model", points.size(),
                weights.size(), num_points());
  // Only points that count are carried along, scaled by the root of their weight over the deviation.
  const auto num_counting = std::count_if(weights.begin(), weights.end(), [](float weight) { return weight > 0; });
  const auto every = std::max<Eigen::Index>(1, num_counting / kEnoughPoints);
  std::vector<int> kept;
  for (int k = 0, counting = 0; k < num_points(); ++k) {
    if (weights[size_t(k)] > 0 && counting++ % every == 0) kept.insert(kept.end(), {2 * k, 2 * k + 1});
  }
  Eigen::VectorXf scale(kept.size()), target(kept.size());
  for (Eigen::Index i = 0; i < scale.size(); ++i) {
    const auto coordinate = size_t(kept[size_t(i)]);
    scale[i] = std::sqrt(weights[coordinate / 2] * float(every)) / float(options_.deviation_px);
    target[i] = scale[i] * points[coordinate];
  }
  const CurveRows core = model_->core(Eigen::all, kept).array().rowwise() * scale.transpose().array();

  CurveCode code;
  code.u = start ? start->u : prior_.u_mean;
  code.v = start ? start->v : prior_.v_mean;
  CurveRows basis;
  for (int round = 0; round < options_.rounds; ++round) {
    basis.setZero(num_identity, core.cols());
    for (int k = 0; k < num_identity; ++k)
      basis.row(k) = code.v.transpose() * core.middleRows(k * num_expression, num_expression);
    code.u = SolveWithPrior(basis, target, prior_.u_mean, prior_.u_deviation);
    basis.setZero(num_expression, core.cols());
    for (int k = 0; k < num_identity; ++k) basis += code.u[k] * core.middleRows(k * num_expression, num_expression);
    code.v = SolveWithPrior(basis, target, prior_.v_mean, prior_.v_deviation);
  }
  code.points = Reconstruct(*model_, code.u, code.v);
  return code;
}

}  // namespace daumier::faces
