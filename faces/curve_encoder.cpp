#include "faces/curve_encoder.h"

#include "core/error.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace daumier::faces {
namespace {

using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Neighbouring points of a curve say about the same: where twice as many are there, some are left out.
constexpr int kEnoughPoints = 150;
/// Below this share of the factors' size a standard deviation says that a factor never changed.
constexpr float kLeastDeviation = 1e-3f;

/// argmin_x |W (A^T x - points)|^2 / deviation^2 + (x - mean)^T precision (x - mean); rows of `basis` are those of A,
/// already multiplied by the square roots W / deviation, as are the points.
Eigen::VectorXf SolveWithPrior(const Rows& basis, const Eigen::VectorXf& points, const Eigen::VectorXf& mean,
                               const Eigen::VectorXf& precision) {
  Eigen::MatrixXd normal = Eigen::MatrixXf(basis * basis.transpose()).cast<double>();
  normal.diagonal() += precision.cast<double>();
  const Eigen::VectorXd right =
      (basis * points).cast<double>() + (precision.cast<double>().array() * mean.cast<double>().array()).matrix();
  return normal.llt().solve(right).cast<float>();
}

}  // namespace

Eigen::VectorXf CurveCode::numbers() const {
  Eigen::VectorXf all(u.size() + v.size());
  all << u, v;
  return all;
}

CurveEncoder::Prior CurveEncoder::PriorOf(const Eigen::MatrixXf& factors) {
  Prior prior;
  prior.mean = factors.colwise().mean();
  const Eigen::MatrixXf centred = factors.rowwise() - prior.mean.transpose();
  const Eigen::VectorXf deviation = (centred.colwise().squaredNorm() / float(factors.rows()))
                                        .cwiseSqrt()
                                        .cwiseMax(kLeastDeviation * prior.mean.norm());
  prior.precision = deviation.cwiseAbs2().cwiseInverse();
  return prior;
}

CurveEncoder::CurveEncoder(const BilinearModel& model, const CurveEncoderOptions& options)
    : model_(&model),
      options_(options),
      identity_(PriorOf(model.identity_factors)),
      expression_(PriorOf(model.expression_factors)) {}

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
  const Rows core = model_->core(Eigen::all, kept).array().rowwise() * scale.transpose().array();

  CurveCode code;
  code.u = start ? start->u : identity_.mean;
  code.v = start ? start->v : expression_.mean;
  Rows basis;
  for (int round = 0; round < options_.rounds; ++round) {
    basis.setZero(num_identity, core.cols());
    for (int k = 0; k < num_identity; ++k)
      basis.row(k) = code.v.transpose() * core.middleRows(k * num_expression, num_expression);
    code.u = SolveWithPrior(basis, target, identity_.mean, identity_.precision);
    basis.setZero(num_expression, core.cols());
    for (int k = 0; k < num_identity; ++k) basis += code.u[k] * core.middleRows(k * num_expression, num_expression);
    code.v = SolveWithPrior(basis, target, expression_.mean, expression_.precision);
  }
  code.points = Reconstruct(*model_, code.u, code.v);
  return code;
}

}  // namespace daumier::faces
