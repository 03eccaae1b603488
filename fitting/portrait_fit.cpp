#include "fitting/portrait_fit.h"

#include "core/error.h"

#include <ceres/cost_function.h>
#include <ceres/normal_prior.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <Eigen/Geometry>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

namespace daumier::fitting {
namespace {

using PortraitRows = LandmarkModel::Rows;

/// sqrt(w) / deviation of each number of the landmarks, and the landmarks.
struct PortraitTarget {
  Eigen::VectorXd scale, pixels;  ///< 136
  double sum_of_weights = 0;
};

class PortraitLandmarkCost : public ceres::CostFunction {
 public:
  PortraitLandmarkCost(const LandmarkModel& model, const PortraitTarget& target) : model_(model), target_(target) {
    set_num_residuals(int(target.pixels.size()));
    *mutable_parameter_block_sizes() = {6, model.num_identity(), model.num_expression()};
  }

  bool Evaluate(const double* const* parameters, double* residuals, double** jacobians) const override {
    const auto& sizes = parameter_block_sizes();
    const LandmarkModel::Value value = model_.At(Eigen::Map<const PortraitPose>(parameters[0]),
                                                 Eigen::Map<const Eigen::VectorXd>(parameters[1], sizes[1]),
                                                 Eigen::Map<const Eigen::VectorXd>(parameters[2], sizes[2]));
    if (!value.pixels.allFinite()) return false;
    Eigen::Map<Eigen::VectorXd>(residuals, num_residuals()) = target_.scale.cwiseProduct(value.pixels - target_.pixels);
    if (jacobians == nullptr) return true;
    const PortraitRows* const parts[] = {&value.by_pose, &value.by_identity, &value.by_expression};
    for (int block = 0; block < 3; ++block)
      if (jacobians[block] != nullptr)
        Eigen::Map<PortraitRows>(jacobians[block], num_residuals(), sizes[size_t(block)]) =
            target_.scale.asDiagonal() * *parts[block];
    return true;
  }

 private:
  const LandmarkModel& model_;
  const PortraitTarget& target_;
};

/// About given coefficients, or about 0.
ceres::CostFunction* PriorAbout(const Eigen::VectorXd& start, bool about_start, double deviation) {
  const ceres::Matrix weights = ceres::Matrix::Identity(start.size(), start.size()) / deviation;
  const ceres::Vector zero = ceres::Vector::Zero(start.size());
  return std::make_unique<ceres::NormalPrior>(weights, about_start ? ceres::Vector(start) : zero).release();
}

PortraitTarget TargetOf(const PicturePoints& landmarks, const Eigen::VectorXd& weights, double deviation_px) {
  DAUMIER_CHECK(landmarks.rows() == 68 && weights.size() == 68,
                "{} landmarks and {} weights of a portrait, expected 68", landmarks.rows(), weights.size());
  PortraitTarget target{Eigen::VectorXd(136), Eigen::Map<const Eigen::VectorXd>(landmarks.data(), 136)};
  int count = 0;
  for (int n = 0; n < 68; ++n) {
    DAUMIER_CHECK(weights[n] >= 0, "landmark {} has the weight {}", n, weights[n]);
    target.scale.segment<2>(2 * n).setConstant(std::sqrt(weights[n]) / deviation_px);
    target.sum_of_weights += weights[n];
    if (weights[n] > 0) ++count;
    // A landmark that does not count may be anything, also not a number.
    if (weights[n] == 0) target.pixels.segment<2>(2 * n).setZero();
  }
  DAUMIER_CHECK(count >= 4, "{} landmarks count; a pose needs 4 or more", count);
  return target;
}

/// A pose of this yaw in which landmarks of the mean face have the place and the size of the given ones.
PortraitPose StartPose(const LandmarkModel& model, const PortraitTarget& target, double yaw) {
  constexpr double kUsualDepth = -45;
  PortraitPose pose = PortraitPose::Zero();
  pose[1] = yaw;
  pose[5] = kUsualDepth;
  const PortraitView view;
  for (int round = 0; round < 3; ++round) {
    const Eigen::VectorXd pixels =
        model.At(pose, Eigen::VectorXd::Zero(model.num_identity()), Eigen::VectorXd::Zero(model.num_expression()))
            .pixels;
    Eigen::Vector2d mean = Eigen::Vector2d::Zero(), target_mean = mean;
    double sum = 0;
    for (int n = 0; n < 68; ++n) {
      const double w = target.scale[2 * n];
      mean += w * pixels.segment<2>(2 * n);
      target_mean += w * target.pixels.segment<2>(2 * n);
      sum += w;
    }
    mean /= sum, target_mean /= sum;
    double spread = 0, target_spread = 0;
    for (int n = 0; n < 68; ++n) {
      const double w = target.scale[2 * n];
      spread += w * (pixels.segment<2>(2 * n) - mean).squaredNorm();
      target_spread += w * (target.pixels.segment<2>(2 * n) - target_mean).squaredNorm();
    }
    DAUMIER_CHECK(target_spread > 0, "all landmarks are in one point");
    const double ratio = std::sqrt(target_spread / spread), depth = view.distance - pose[5];
    pose[5] = view.distance - depth / ratio;
    const double cm_per_px = depth / ratio / view.focal;
    pose[3] += (target_mean.x() - mean.x()) * cm_per_px;
    pose[4] -= (target_mean.y() - mean.y()) * cm_per_px;
  }
  return pose;
}

struct PortraitUnknowns {
  PortraitPose pose;
  Eigen::VectorXd identity, expression;
};

/// Which of the unknowns are found.
struct FreeUnknowns {
  bool pose = true, identity = true, expression = true;
};
constexpr FreeUnknowns kPoseAlone{.identity = false, .expression = false};

double SolvePortrait(const LandmarkModel& model, const PortraitTarget& target, const PortraitFitOptions& options,
                     const FreeUnknowns& free, PortraitUnknowns& unknowns) {
  ceres::Problem problem;
  double *const pose = unknowns.pose.data(), *const identity = unknowns.identity.data(),
                *const expression = unknowns.expression.data();
  problem.AddResidualBlock(new PortraitLandmarkCost(model, target), nullptr, pose, identity, expression);
  if (!free.pose) problem.SetParameterBlockConstant(pose);
  if (!free.identity) {
    problem.SetParameterBlockConstant(identity);
  } else {
    problem.AddResidualBlock(PriorAbout(unknowns.identity, options.about_start, options.identity_deviation), nullptr,
                             identity);
  }
  if (!free.expression) {
    problem.SetParameterBlockConstant(expression);
  } else {
    const bool unit = model.expression_weights() == faces::ExpressionWeights::kUnit;
    problem.AddResidualBlock(
        PriorAbout(unknowns.expression, options.about_start, unit ? options.expression_deviation : 1), nullptr,
        expression);
    for (int e = 0; unit && e < model.num_expression(); ++e) {
      problem.SetParameterLowerBound(expression, e, 0);
      problem.SetParameterUpperBound(expression, e, 1);
    }
  }
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  solver.max_num_iterations = options.iterations;
  solver.function_tolerance = 1e-5;
  solver.num_threads = 1;
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  DAUMIER_CHECK(summary.IsSolutionUsable(), "the portrait could not be fitted: {}", summary.message);
  return summary.final_cost;
}

PortraitFit FitOf(const LandmarkModel& model, const PortraitTarget& target, double deviation_px,
                  const PortraitUnknowns& found, Eigen::VectorXf coefficients) {
  PortraitFit fit{std::move(coefficients)};
  fit.coefficients.segment(faces::kIdentitySlot.first, model.num_identity()) = found.identity.cast<float>();
  fit.coefficients.segment(faces::kExpressionSlot.first, model.num_expression()) = found.expression.cast<float>();
  fit.coefficients.segment(faces::kPoseSlot.first, 6) = found.pose.cast<float>();
  const Eigen::VectorXd pixels = model.At(found.pose, found.identity, found.expression).pixels;
  fit.rms_px =
      deviation_px * std::sqrt(target.scale.cwiseProduct(pixels - target.pixels).squaredNorm() / target.sum_of_weights);
  return fit;
}

}  // namespace

LandmarkModel::LandmarkModel(const faces::MorphableModel& model)
    : mean_(68, 3),
      identity_(204, model.identity.cols()),
      expression_(204, model.expression.cols()),
      expression_weights_(model.expression_weights) {
  for (int n = 0; n < 68; ++n) {
    const int vertex = model.face_template.annotation.landmarks[size_t(n)];
    mean_.row(n) = model.face_template.neutral.row(vertex);
    identity_.middleRows(3 * n, 3) = model.identity.middleRows(3 * vertex, 3).cast<double>();
    expression_.middleRows(3 * n, 3) = model.expression.middleRows(3 * vertex, 3).cast<double>();
  }
}

geometry::Points LandmarkModel::Landmarks(const Eigen::VectorXd& identity, const Eigen::VectorXd& expression) const {
  const Eigen::VectorXd offset = identity_ * identity + expression_ * expression;
  return mean_ + Eigen::Map<const geometry::Points>(offset.data(), 68, 3);
}

LandmarkModel::Value LandmarkModel::At(const PortraitPose& pose, const Eigen::VectorXd& identity,
                                       const Eigen::VectorXd& expression, const PortraitView& view) const {
  using Eigen::AngleAxisd, Eigen::Vector3d, Eigen::Matrix3d;
  const geometry::Points points = Landmarks(identity, expression);
  const Matrix3d rx = AngleAxisd(pose[0], Vector3d::UnitX()).toRotationMatrix(),
                 ry = AngleAxisd(pose[1], Vector3d::UnitY()).toRotationMatrix(),
                 rz = AngleAxisd(pose[2], Vector3d::UnitZ()).toRotationMatrix();
  // The derivative of a rotation about an axis is that rotation times the axis' cross product matrix.
  const auto cross = [](const Vector3d& axis) {
    Matrix3d matrix;
    matrix << 0, -axis.z(), axis.y(), axis.z(), 0, -axis.x(), -axis.y(), axis.x(), 0;
    return matrix;
  };
  const Matrix3d rotation = rz * ry * rx, by_pitch = rotation * cross(Vector3d::UnitX()),
                 by_yaw = rz * ry * cross(Vector3d::UnitY()) * rx, by_roll = rz * cross(Vector3d::UnitZ()) * ry * rx;
  Value value{Eigen::VectorXd(136), PortraitRows(136, 6), PortraitRows(136, num_identity()),
              PortraitRows(136, num_expression())};
  for (int n = 0; n < 68; ++n) {
    const Vector3d p = points.row(n), x = rotation * p + pose.tail<3>();
    const double depth = view.distance - x.z(), scale = view.focal / depth;
    value.pixels.segment<2>(2 * n) << view.centre + scale * x.x(), view.centre - scale * x.y();
    Eigen::Matrix<double, 2, 3> by_point;
    by_point << scale, 0, scale * x.x() / depth, 0, -scale, -scale * x.y() / depth;
    auto by_pose = value.by_pose.middleRows(2 * n, 2);
    by_pose.col(0) = by_point * (by_pitch * p);
    by_pose.col(1) = by_point * (by_yaw * p);
    by_pose.col(2) = by_point * (by_roll * p);
    by_pose.rightCols(3) = by_point;
    const Eigen::Matrix<double, 2, 3> by_model = by_point * rotation;
    value.by_identity.middleRows(2 * n, 2) = by_model * identity_.middleRows(3 * n, 3);
    value.by_expression.middleRows(2 * n, 2) = by_model * expression_.middleRows(3 * n, 3);
  }
  return value;
}

PortraitFit FitPortrait(const LandmarkModel& model, const PicturePoints& landmarks, const Eigen::VectorXd& weights,
                        const PortraitFitOptions& options) {
  const PortraitTarget target = TargetOf(landmarks, weights, options.deviation_px);
  PortraitUnknowns best;
  double least = std::numeric_limits<double>::infinity();
  for (const double degrees : {0.0, -40.0, 40.0}) {
    PortraitUnknowns start{StartPose(model, target, degrees * std::numbers::pi / 180),
                           Eigen::VectorXd::Zero(model.num_identity()), Eigen::VectorXd::Zero(model.num_expression())};
    const double cost = SolvePortrait(model, target, options, kPoseAlone, start);
    if (cost >= least) continue;
    least = cost;
    best = start;
  }
  if (options.freedom == PortraitFreedom::kPoseAndFace) SolvePortrait(model, target, options, {}, best);
  return FitOf(model, target, options.deviation_px, best, Eigen::VectorXf::Zero(faces::kNumCoefficients));
}

PortraitFit AdjustPortrait(const LandmarkModel& model, const Eigen::VectorXf& coefficients,
                           const PicturePoints& landmarks, const Eigen::VectorXd& weights,
                           PortraitAdjustment adjustment, const PortraitFitOptions& options) {
  DAUMIER_CHECK(coefficients.size() == faces::kNumCoefficients, "{} coefficients of a portrait, expected {}",
                coefficients.size(), faces::kNumCoefficients);
  const PortraitTarget target = TargetOf(landmarks, weights, options.deviation_px);
  PortraitUnknowns found{coefficients.segment(faces::kPoseSlot.first, 6).cast<double>(),
                         coefficients.segment(faces::kIdentitySlot.first, model.num_identity()).cast<double>(),
                         coefficients.segment(faces::kExpressionSlot.first, model.num_expression()).cast<double>()};
  const bool all = adjustment == PortraitAdjustment::kAll;
  SolvePortrait(model, target, options,
                {.pose = all || adjustment == PortraitAdjustment::kPose,
                 .identity = all || adjustment == PortraitAdjustment::kIdentityAndExpression,
                 .expression = adjustment != PortraitAdjustment::kPose},
                found);
  return FitOf(model, target, options.deviation_px, found, coefficients);
}

}  // namespace daumier::fitting
