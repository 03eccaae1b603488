#include "faces/bilinear_projector.h"

#include "core/error.h"
#include "core/parallel.h"

#include <algorithm>
#include <cmath>

namespace daumier::faces {

BilinearProjector::BilinearProjector(const BilinearModel& model, const Eigen::VectorXf& coordinate_weights)
    : model_(&model), weights_(Eigen::VectorXd::Ones(model.num_coordinates())) {
  DAUMIER_CHECK(coordinate_weights.size() == 0 || coordinate_weights.size() == weights_.size(),
                "{} weights for the {} coordinates of a bilinear model", coordinate_weights.size(), weights_.size());
  if (coordinate_weights.size() > 0) weights_ = coordinate_weights.cast<double>();
  DAUMIER_CHECK(weights_.minCoeff() >= 0, "a coordinate has the negative weight {}", weights_.minCoeff());
  const Eigen::VectorXd roots = weights_.cwiseSqrt();

  gram_ = Eigen::MatrixXd::Zero(model.core.rows(), model.core.rows());
  constexpr int kChunk = 1024;
  ForEachInOrder((model.num_coordinates() + kChunk - 1) / kChunk,
                 [&](int block) {
                   const int begin = block * kChunk, size = std::min(kChunk, model.num_coordinates() - begin);
                   const Eigen::MatrixXd columns =
                       model.core.middleCols(begin, size).cast<double>() * roots.segment(begin, size).asDiagonal();
                   Eigen::MatrixXd part = Eigen::MatrixXd::Zero(gram_.rows(), gram_.cols());
                   part.selfadjointView<Eigen::Lower>().rankUpdate(columns);
                   return part;
                 },
                 [&](const Eigen::MatrixXd& part) { gram_ += part; });
  gram_.triangularView<Eigen::StrictlyUpper>() = gram_.transpose();

  for (Eigen::Index e = 0; e < model.expression_factors.rows(); ++e) {
    starts_.emplace_back(IdentityGram(model.expression_factors.row(e).transpose().cast<double>()));
  }
  DAUMIER_CHECK(!starts_.empty(), "a bilinear model without fitted expressions cannot be projected to");
}

/// Ku x Ku: sum_ll' v_l v_l' G(kl, k'l').
Eigen::MatrixXd BilinearProjector::IdentityGram(const Eigen::VectorXd& v) const {
  const int ku = model_->num_identity, kv = model_->num_expression;
  Eigen::MatrixXd half(ku * kv, ku), result(ku, ku);
  for (int k = 0; k < ku; ++k) half.col(k).noalias() = gram_.middleCols(k * kv, kv) * v;
  for (int k = 0; k < ku; ++k) result.row(k).noalias() = v.transpose() * half.middleRows(k * kv, kv);
  return result;
}

/// Ku Kv x Kv: sum_k' u_k' G(kl, k'l').
Eigen::MatrixXd BilinearProjector::HalfExpressionGram(const Eigen::VectorXd& u) const {
  const int ku = model_->num_identity, kv = model_->num_expression;
  Eigen::MatrixXd half = Eigen::MatrixXd::Zero(ku * kv, kv);
  for (int k = 0; k < ku; ++k) half += u(k) * gram_.middleCols(k * kv, kv);
  return half;
}

BilinearProjection BilinearProjector::Project(std::span<const float> face) const {
  const int ku = model_->num_identity, kv = model_->num_expression;
  DAUMIER_CHECK(static_cast<int>(face.size()) == model_->num_coordinates(),
                "face has {} coordinates, the bilinear model expects {}", face.size(), model_->num_coordinates());
  const Eigen::VectorXd target =
      Eigen::Map<const Eigen::VectorXf>(face.data(), Eigen::Index(face.size())).cast<double>();
  const Eigen::VectorXd weighted = weights_.cwiseProduct(target);
  Eigen::MatrixXd linear(kv, ku);  // Column k holds the expression weights: h(k * Kv + l) = linear(l, k).
  for (int r = 0; r < ku * kv; ++r) linear.data()[r] = model_->core.row(r).cast<double>().dot(weighted);

  // With u solved for a given v, the error is g'Wg - u . h_v: the best start has the largest u . h_v.
  Eigen::VectorXd start;
  double best = -1.0;
  for (size_t e = 0; e < starts_.size(); ++e) {
    const Eigen::VectorXd expression = model_->expression_factors.row(Eigen::Index(e)).transpose().cast<double>();
    const Eigen::VectorXd projected = linear.transpose() * expression;
    if (const double gain = starts_[e].solve(projected).dot(projected); gain > best) {
      best = gain;
      start = expression;
    }
  }
  // Both at once by Gauss-Newton, and where that gains nothing one after the other, which always gains.
  struct Solution {
    Eigen::VectorXd v;
    Eigen::LDLT<Eigen::MatrixXd> identity_gram;
    Eigen::VectorXd u;
    double gain;
  };
  const auto solve_u = [&](Eigen::VectorXd v) {
    v *= std::copysign(start.norm() / std::max(v.norm(), 1e-150), v.dot(start));
    Solution solution{v, Eigen::LDLT<Eigen::MatrixXd>(IdentityGram(v)), {}, 0};
    const Eigen::VectorXd projected = linear.transpose() * v;
    solution.u = solution.identity_gram.solve(projected);
    solution.gain = solution.u.dot(projected);
    return solution;
  };
  Solution solution = solve_u(start);
  constexpr int kMaxRounds = 100;
  const double smallest_gain = 1e-10 * weighted.dot(target);
  for (int round = 0; round < kMaxRounds; ++round) {
    const auto& [v, identity_gram, u, gain] = solution;
    const Eigen::MatrixXd half = HalfExpressionGram(u);
    Eigen::MatrixXd expression_gram = Eigen::MatrixXd::Zero(kv, kv), cross(ku, kv);
    for (int k = 0; k < ku; ++k) {
      expression_gram += u(k) * half.middleRows(k * kv, kv);
      cross.row(k).noalias() = v.transpose() * half.middleRows(k * kv, kv);
    }
    const Eigen::VectorXd gradient = linear * u - expression_gram * v;
    // u eliminated. The scale of v, which u can undo, is held.
    Eigen::MatrixXd reduced = expression_gram - cross.transpose() * identity_gram.solve(cross);
    reduced += expression_gram.trace() / v.squaredNorm() * v * v.transpose();
    Solution next = solve_u(v + reduced.ldlt().solve(gradient));
    if (!(next.gain > gain)) next = solve_u(expression_gram.ldlt().solve(linear * u));
    const double gained = next.gain - gain;
    if (gained > 0) solution = std::move(next);
    if (gained <= smallest_gain) break;
  }
  BilinearProjection result{solution.u.cast<float>(), solution.v.cast<float>(), {}};
  result.vertices = Reconstruct(*model_, result.u, result.v);
  return result;
}

}  // namespace daumier::faces
