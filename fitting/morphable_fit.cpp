#include "fitting/morphable_fit.h"

#include "core/error.h"
#include "faces/coefficient_prior.h"

#include <ceres/cost_function.h>
#include <ceres/normal_prior.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <cmath>
#include <memory>
#include <vector>

namespace daumier::fitting {
namespace {

using Rows = KeyPointResiduals::Rows;

class KeyPointCost : public ceres::CostFunction {
 public:
  KeyPointCost(const KeyPointResiduals& residuals, int num_identity, int num_expression) : residuals_(residuals) {
    set_num_residuals(residuals.num_residuals());
    *mutable_parameter_block_sizes() = {num_identity, num_expression};
  }

  bool Evaluate(const double* const* parameters, double* residuals, double** jacobians) const override {
    const auto& sizes = parameter_block_sizes();
    const auto value = residuals_.At(Eigen::Map<const Eigen::VectorXd>(parameters[0], sizes[0]),
                                     Eigen::Map<const Eigen::VectorXd>(parameters[1], sizes[1]));
    Eigen::Map<Eigen::VectorXd>(residuals, num_residuals()) = value.residuals;
    if (jacobians && jacobians[0]) Eigen::Map<Rows>(jacobians[0], num_residuals(), sizes[0]) = value.by_u;
    if (jacobians && jacobians[1]) Eigen::Map<Rows>(jacobians[1], num_residuals(), sizes[1]) = value.by_v;
    return true;
  }

 private:
  const KeyPointResiduals& residuals_;
};

/// |(x - mean) / deviation|^2, without the half that Ceres takes of all squares alike.
std::unique_ptr<ceres::CostFunction> PriorCost(const Eigen::VectorXf& mean, const Eigen::VectorXf& deviation) {
  const ceres::Matrix weights = deviation.cast<double>().cwiseInverse().asDiagonal();
  return std::make_unique<ceres::NormalPrior>(weights, mean.cast<double>());
}

}  // namespace

KeyPointResiduals::KeyPointResiduals(const ProjectedModel& model, std::span<const float> points,
                                     std::span<const float> weights, double deviation_px)
    : num_identity_(model.model.num_identity), num_expression_(model.model.num_expression) {
  const auto num_points = size_t(model.model.num_coordinates() / 2);
  DAUMIER_CHECK(points.size() == 2 * num_points && weights.size() == num_points,
                "{} coordinates and {} weights were given for a face of {} key points", points.size(), weights.size(),
                num_points);
  std::vector<int> kept;
  for (size_t k = 0; k < num_points; ++k) {
    DAUMIER_CHECK(weights[k] >= 0, "key point {} has the weight {}", k, weights[k]);
    if (weights[k] == 0) continue;
    kept.insert(kept.end(), {int(2 * k), int(2 * k + 1)});
    sum_of_weights_ += weights[k];
  }
  DAUMIER_CHECK(!kept.empty(), "none of {} key points counts", num_points);
  core_ = model.model.core(Eigen::all, kept).cast<double>();
  target_.resize(core_.cols());
  for (Eigen::Index i = 0; i < target_.size(); ++i) {
    const int coordinate = kept[size_t(i)];
    const double scale = std::sqrt(double(weights[size_t(coordinate / 2)])) / deviation_px;
    core_.col(i) *= scale;
    target_[i] = scale * (double(points[size_t(coordinate)]) - double(model.constant[coordinate]));
  }
}

KeyPointResiduals::Value KeyPointResiduals::At(const Eigen::VectorXd& u, const Eigen::VectorXd& v) const {
  Value value;
  value.by_u.resize(target_.size(), num_identity_);
  value.by_v = Rows::Zero(target_.size(), num_expression_);
  for (int k = 0; k < num_identity_; ++k) {
    const auto rows = core_.middleRows(k * num_expression_, num_expression_);
    value.by_u.col(k) = rows.transpose() * v;
    value.by_v += u[k] * rows.transpose();
  }
  value.residuals = value.by_v * v - target_;
  return value;
}

MorphableFit FitMorphable(const ProjectedModel& model, std::span<const float> points, std::span<const float> weights,
                          const MorphableFitOptions& options) {
  const KeyPointResiduals residuals(model, points, weights, options.deviation_px);
  const faces::CoefficientPrior prior = faces::PriorOf(model.model);
  Eigen::VectorXd u = prior.u_mean.cast<double>(), v = prior.v_mean.cast<double>();

  ceres::Problem problem;
  problem.AddResidualBlock(new KeyPointCost(residuals, int(u.size()), int(v.size())), nullptr, u.data(), v.data());
  if (options.prior) {
    problem.AddResidualBlock(PriorCost(prior.u_mean, prior.u_deviation).release(), nullptr, u.data());
    problem.AddResidualBlock(PriorCost(prior.v_mean, prior.v_deviation).release(), nullptr, v.data());
  }
  ceres::Solver::Options solver;
  // Without a prior the normal equations are all but singular.
  solver.linear_solver_type = options.prior ? ceres::DENSE_NORMAL_CHOLESKY : ceres::DENSE_QR;
  solver.max_num_iterations = options.iterations;
  solver.function_tolerance = 1e-7;
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  DAUMIER_CHECK(summary.IsSolutionUsable(), "the face could not be fitted: {}", summary.message);

  const double squares = residuals.At(u, v).residuals.squaredNorm();
  MorphableFit fit;
  fit.rms_px = options.deviation_px * std::sqrt(squares / residuals.sum_of_weights());
  fit.iterations = static_cast<int>(summary.iterations.size()) - 1;
  if (!options.prior) {
    const double length = v.norm() / prior.v_mean.cast<double>().norm();
    DAUMIER_CHECK(length > 0, "the face could not be fitted: its expression vanishes");
    u *= length, v /= length;
  }
  fit.u = u.cast<float>(), fit.v = v.cast<float>();
  return fit;
}

}  // namespace daumier::fitting
