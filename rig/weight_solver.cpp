#include "rig/weight_solver.h"

#include "core/error.h"
#include "rig/arkit_names.h"
#include "rig/bounded_least_squares.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <ranges>

namespace daumier::rig {
namespace {

Eigen::Index JawOpen() {
  static const Eigen::Index index = *FindArkitName("jawOpen");
  return index;
}

Eigen::Index MouthClose() {
  static const Eigen::Index index = *FindArkitName("mouthClose");
  return index;
}

}  // namespace

Eigen::VectorXd MostWeights(double most, GazeTargets gaze) {
  Eigen::VectorXd bounds = Eigen::VectorXd::Constant(kNumArkitNames, most);
  for (int t = 0; t < kNumArkitNames; ++t) {
    const std::string_view name = ArkitNames()[size_t(t)];
    if (name == "tongueOut" || (gaze == GazeTargets::kZero && name.starts_with("eyeLook"))) bounds[t] = 0;
  }
  return bounds;
}

WeightSolver::WeightSolver(const MorphTargets& targets, const Eigen::VectorXd& masses, const Eigen::VectorXd& most)
    : num_vertices_(masses.size()), most_(most) {
  DAUMIER_CHECK(std::ranges::equal(targets.names, ArkitNames()), "the targets are not the 52 of ARKit in their order");
  DAUMIER_CHECK(targets.offsets.rows() == 3 * num_vertices_ && targets.offsets.cols() == kNumArkitNames &&
                    most.size() == kNumArkitNames,
                "targets of {} coordinates, masses of {} vertices and {} bounds do not fit", targets.offsets.rows(),
                num_vertices_, most.size());
  for (Eigen::Index v = 0; v < num_vertices_; ++v)
    if (masses[v] > 0) vertices_.push_back(v);
  DAUMIER_CHECK(!vertices_.empty(), "no vertex of the face has an area");
  masses_ = masses(vertices_);
  rows_ = Weighted(targets.offsets.cast<double>());
  gram_ = rows_.transpose() * rows_;
}

Eigen::MatrixXd WeightSolver::Weighted(const Eigen::Ref<const Eigen::MatrixXd>& columns) const {
  DAUMIER_CHECK(columns.rows() == 3 * num_vertices_, "a displacement has {} coordinates, expected {}", columns.rows(),
                3 * num_vertices_);
  Eigen::MatrixXd weighted(3 * masses_.size(), columns.cols());
  for (Eigen::Index i = 0; i < masses_.size(); ++i)
    weighted.middleRows<3>(3 * i) = std::sqrt(masses_[i]) * columns.middleRows<3>(3 * vertices_[size_t(i)]);
  DAUMIER_CHECK(weighted.allFinite(), "a displacement is not finite");
  return weighted;
}

/// With the sum of jawOpen and mouthClose instead of mouthClose, its bound is that of any other variable: at least 0.
Eigen::VectorXd WeightSolver::Bounded(const Eigen::MatrixXd& gram, const Eigen::VectorXd& right) const {
  Eigen::MatrixXd sums = Eigen::MatrixXd::Identity(kNumArkitNames, kNumArkitNames);
  sums(JawOpen(), MouthClose()) = 1;
  Eigen::VectorXd weights = sums * BoundedLeastSquares(sums.transpose() * gram * sums, sums.transpose() * right, most_);
  weights[JawOpen()] = std::min(weights[JawOpen()], most_[JawOpen()]);
  weights[MouthClose()] = std::min(weights[MouthClose()], weights[JawOpen()]);
  return weights;
}

Eigen::VectorXd WeightSolver::Solve(const Eigen::VectorXd& displacement) const {
  return Bounded(gram_, rows_.transpose() * Weighted(displacement).col(0));
}

WeightSolver::WithMotions WeightSolver::Solve(const Eigen::VectorXd& displacement,
                                              const Eigen::MatrixXd& motions) const {
  const Eigen::MatrixXd free = Weighted(motions);
  const Eigen::VectorXd wanted = Weighted(displacement);
  const Eigen::LDLT<Eigen::MatrixXd> factor(free.transpose() * free);
  const Eigen::MatrixXd coupling = free.transpose() * rows_, share = factor.solve(coupling);
  const Eigen::VectorXd of_motions = free.transpose() * wanted;
  const Eigen::VectorXd weights =
      Bounded(gram_ - coupling.transpose() * share, rows_.transpose() * wanted - share.transpose() * of_motions);
  return {weights, factor.solve(of_motions - coupling * weights)};
}

DisplacementError WeightSolver::ErrorOf(const Eigen::VectorXd& displacement, const Eigen::VectorXd& weights) const {
  const Eigen::VectorXd left = rows_ * weights - Weighted(displacement).col(0);
  DisplacementError error{std::sqrt(left.squaredNorm() / masses_.sum()), 0};
  for (Eigen::Index i = 0; i < masses_.size(); ++i)
    error.greatest_cm = std::max(error.greatest_cm, left.segment<3>(3 * i).norm() / std::sqrt(masses_[i]));
  return error;
}

Eigen::VectorXd WeightSolver::Displacement(const Eigen::VectorXd& weights) const {
  const Eigen::VectorXd weighted = rows_ * weights;
  Eigen::VectorXd displacement = Eigen::VectorXd::Zero(3 * num_vertices_);
  for (Eigen::Index i = 0; i < masses_.size(); ++i)
    displacement.segment<3>(3 * vertices_[size_t(i)]) = weighted.segment<3>(3 * i) / std::sqrt(masses_[i]);
  return displacement;
}

}  // namespace daumier::rig
