#include "fitting/code_handles.h"

#include "core/error.h"
#include "core/evenly_spaced.h"
#include "fitting/gauss_newton.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace daumier::fitting {
namespace {

/// Most vertices of `outside` that resist.
constexpr int kMostOutside = 300;
/// Deviations as shares of the largest move: where they begin, and the least.
constexpr double kFirstHandleShare = 0.2, kLeastHandleShare = 1e-4;
constexpr double kFirstOutsideShare = 1.0, kLeastOutsideShare = 1e-3;
constexpr double kFall = 0.5;
/// A derivative serves codes that are nearer than this.
constexpr double kSameDerivative = 0.33;

/// The factor of a handle's deviation by which a residual becomes 0.8 kHeldShare: a handle misses its target by
/// s^2 / (s^2 + a^2) of its move.
double HoldingFactor(double residual_share) {
  const double share = std::clamp(residual_share, 1e-6, 1 - 1e-6), wanted = 0.8 * kHeldShare;
  return std::clamp(std::sqrt(wanted / (1 - wanted) * (1 - share) / share), 0.05, 0.8);
}

}  // namespace

HandleEditor::HandleEditor(const CodeModel& model, Eigen::VectorXd code, std::vector<int> handles,
                           HandleOptions options)
    : model_(model),
      first_code_(std::move(code)),
      handles_(std::move(handles)),
      options_(std::move(options)),
      points_(handles_),
      code_(first_code_) {
  const int num_vertices = model.face_template().num_vertices();
  DAUMIER_CHECK(!handles_.empty(), "an edit by handles has no handle");
  DAUMIER_CHECK(first_code_.size() == model.num_numbers(), "a code of {} numbers, expected {}", first_code_.size(),
                model.num_numbers());
  DAUMIER_CHECK(!options_.deviation_cm || *options_.deviation_cm > 0, "the deviation of a handle is {} cm",
                options_.deviation_cm.value_or(0));
  const std::vector<int> resisting = EvenlySpaced(options_.outside, kMostOutside);
  points_.insert(points_.end(), resisting.begin(), resisting.end());
  for (size_t p = 0; p < points_.size(); ++p) {
    DAUMIER_CHECK(points_[p] >= 0 && points_[p] < num_vertices, "vertex {} does not exist (the face has {})",
                  points_[p], num_vertices);
    DAUMIER_CHECK(p >= handles_.size() || std::count(handles_.begin(), handles_.end(), points_[p]) == 1,
                  "vertex {} has two handles", points_[p]);
  }
  first_positions_ = model.Positions(first_code_, points_);
  const Eigen::Index count(handles_.size());
  places_ = Eigen::Map<const geometry::Points>(first_positions_.data(), count, 3);
  for (const int number : options_.fixed)
    DAUMIER_CHECK(number >= 0 && number < model.num_numbers(), "the code has no number {} (it has {})", number,
                  model.num_numbers());
}

Eigen::MatrixXd HandleEditor::Derivative(const Eigen::VectorXd& code) {
  const bool is_known =
      derivative_.size() > 0 && (model_.is_linear() || (code - derivative_code_).norm() < kSameDerivative);
  if (is_known) return derivative_;
  derivative_ = model_.Derivative(code, points_);
  derivative_code_ = code;
  for (const int number : options_.fixed) derivative_.col(number).setZero();
  return derivative_;
}

HandleEdit HandleEditor::Solve(const geometry::Points& targets, const Deviations& deviations) {
  const Eigen::Index num_numbers = first_code_.size(), num_handle_rows = 3 * Eigen::Index(handles_.size()),
                     num_rows = 3 * Eigen::Index(points_.size());
  Eigen::VectorXd wanted = first_positions_, weights(num_rows);
  wanted.head(num_handle_rows) = Eigen::Map<const Eigen::VectorXd>(targets.data(), num_handle_rows);
  weights.head(num_handle_rows).setConstant(1 / deviations.handle);
  const double num_outside = std::max(1.0, double(points_.size() - handles_.size()));
  weights.tail(num_rows - num_handle_rows).setConstant(1 / (deviations.outside * std::sqrt(num_outside)));
  const SquaredEnergy energy{.residuals = [&](const Eigen::VectorXd& code) -> Eigen::VectorXd {
                               return weights.cwiseProduct(model_.Positions(code, points_) - wanted);
                             },
                             .derivative = [&](const Eigen::VectorXd& code) -> Eigen::MatrixXd {
                               return weights.asDiagonal() * Derivative(code);
                             },
                             .prior_weights = Eigen::VectorXd::Ones(num_numbers),
                             .prior_mean = first_code_,
                             .is_linear = model_.is_linear()};
  Minimum minimum = Minimise(energy, code_, options_.steps);
  HandleEdit edit;
  edit.code = std::move(minimum.x);
  edit.energies = std::move(minimum.energies);
  edit.deviation_cm = deviations.handle;
  const double move = (targets - places_).rowwise().norm().maxCoeff();
  const Eigen::VectorXd positions = model_.Positions(edit.code, points_);
  const auto rows = [](const Eigen::VectorXd& numbers) {
    return Eigen::Map<const geometry::Points>(numbers.data(), numbers.size() / 3, 3);
  };
  const auto misses = (rows(positions) - rows(wanted)).rowwise().norm().eval();
  const Eigen::Index num_handles(handles_.size());
  if (move > 0) {
    edit.residual_share = misses.head(num_handles).maxCoeff() / move;
    if (misses.size() > num_handles) edit.outside_share = misses.tail(misses.size() - num_handles).mean() / move;
  }
  edit.is_usual = edit.code.norm() <= std::max(model_.usual_radius(), first_code_.norm());
  return edit;
}

HandleEdit HandleEditor::MoveTo(const geometry::Points& targets) {
  DAUMIER_CHECK(targets.rows() == places_.rows(), "{} targets of {} handles", targets.rows(), places_.rows());
  DAUMIER_CHECK(targets.allFinite(), "a handle's target is not finite");
  const double move = (targets - places_).rowwise().norm().maxCoeff();
  if (move == 0) {
    code_ = first_code_;
    return {.code = code_, .energies = {0}};
  }
  Deviations deviations{options_.deviation_cm.value_or(kFirstHandleShare * move), kFirstOutsideShare * move};
  const bool is_local = points_.size() > handles_.size();
  const auto is_held = [&](const HandleEdit& edit) {
    return options_.deviation_cm || edit.residual_share <= kHeldShare;
  };
  const auto hold = [&] {
    HandleEdit edit = Solve(targets, deviations);
    while (!is_held(edit) && deviations.handle > kLeastHandleShare * move) {
      code_ = edit.code;
      deviations.handle *= HoldingFactor(edit.residual_share);
      edit = Solve(targets, deviations);
    }
    return edit;
  };
  HandleEdit best = hold();
  while (is_local && is_held(best) && best.outside_share > options_.most_leakage &&
         deviations.outside > kLeastOutsideShare * move) {
    code_ = best.code;
    deviations.outside *= kFall;
    HandleEdit edit = hold();
    if (!is_held(edit)) break;
    best = std::move(edit);
  }
  code_ = best.code;
  return best;
}

HandleEdit EditByHandles(const CodeModel& model, const Eigen::VectorXd& code, const std::vector<int>& handles,
                         const geometry::Points& displacements, const HandleOptions& options) {
  HandleEditor editor(model, code, handles, options);
  return editor.MoveBy(displacements);
}

}  // namespace daumier::fitting
