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
/// A derivative serves codes that are nearer than this; one of many points, which costs far more than a step, longer.
constexpr double kSameDerivative = 0.33, kSameDerivativeOfMany = 1;
constexpr size_t kManyPoints = 32;
/// Steps of a solve end where they lower the energy by less than this share.
constexpr double kLeastFall = 1e-4;

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
  const int num_vertices = model.num_points();
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
  for (const int number : options_.fixed)
    DAUMIER_CHECK(number >= 0 && number < model.num_numbers(), "the code has no number {} (it has {})", number,
                  model.num_numbers());
  for (int number = 0; number < model.num_numbers(); ++number)
    if (std::ranges::count(options_.fixed, number) == 0) free_.push_back(number);
  first_positions_ = model.Positions(first_code_, points_);
  positions_ = first_positions_;
  places_ = Eigen::Map<const geometry::Points>(first_positions_.data(), std::ssize(handles_), 3);
  Linearise(first_code_);
}

bool HandleEditor::IsNear(const Eigen::VectorXd& code) const {
  return model_.is_linear() ||
         (code - derivative_code_).norm() < (points_.size() > kManyPoints ? kSameDerivativeOfMany : kSameDerivative);
}

void HandleEditor::Linearise(const Eigen::VectorXd& code) {
  derivative_ = model_.Derivative(code, points_)(Eigen::all, free_);
  derivative_code_ = code;
  base_ = first_positions_;
  if (code != first_code_) base_ = model_.Positions(code, points_) + derivative_ * (first_code_ - code)(free_);
  quadratic_.emplace(derivative_.topRows(num_handle_rows()), derivative_.bottomRows(3 * num_outside()));
}

Eigen::VectorXd HandleEditor::Missing(const Eigen::VectorXd& positions, const geometry::Points& targets) const {
  Eigen::VectorXd missing = first_positions_ - positions;
  const Eigen::Index num_rows = num_handle_rows();
  missing.head(num_rows) = Eigen::Map<const Eigen::VectorXd>(targets.data(), num_rows) - positions.head(num_rows);
  return missing;
}

HandleEdit HandleEditor::Judged(Eigen::VectorXd code, const Eigen::VectorXd& missing, double move,
                                const Deviations& deviations) const {
  const Eigen::VectorXd lengths =
      Eigen::Map<const geometry::Points>(missing.data(), missing.size() / 3, 3).rowwise().norm();
  HandleEdit edit;
  edit.residual_share = lengths.head(std::ssize(handles_)).maxCoeff() / move;
  if (num_outside() > 0) edit.outside_share = lengths.tail(num_outside()).mean() / move;
  edit.deviation_cm = deviations.handle;
  edit.is_usual = code.norm() <= std::max(model_.usual_radius(), first_code_.norm());
  const Eigen::VectorXd residuals = Weights(deviations).cwiseProduct(missing);
  edit.energies = {residuals.squaredNorm() + (code - first_code_).squaredNorm()};
  edit.code = std::move(code);
  return edit;
}

Eigen::VectorXd HandleEditor::Weights(const Deviations& deviations) const {
  Eigen::VectorXd weights(3 * std::ssize(points_));
  weights.head(num_handle_rows()).setConstant(1 / deviations.handle);
  weights.tail(3 * num_outside()).setConstant(1 / deviations.outside);
  return weights;
}

HandleEdit HandleEditor::Predict(const geometry::Points& targets, double move, const Deviations& deviations) const {
  const Eigen::VectorXd wanted = Missing(base_, targets);
  Eigen::VectorXd outside;  // Of the derivative at the first code all 0.
  if (derivative_code_ != first_code_) outside = wanted.tail(3 * num_outside());
  const Eigen::VectorXd step = quadratic_->Minimum(wanted.head(num_handle_rows()), outside, deviations);
  Eigen::VectorXd code = first_code_;
  code(free_) += step;
  return Judged(std::move(code), wanted - derivative_ * step, move, deviations);
}

HandleEdit HandleEditor::Refine(const geometry::Points& targets, double move, const Deviations& deviations,
                                const Eigen::VectorXd& start) {
  const Eigen::VectorXd weights = Weights(deviations);
  const auto code_of = [&](const Eigen::VectorXd& numbers) {
    Eigen::VectorXd code = first_code_;
    code(free_) = numbers;
    return code;
  };
  bool is_first = true;
  const SquaredEnergy energy{
      .residuals = [&](const Eigen::VectorXd& numbers) -> Eigen::VectorXd {
        return -weights.cwiseProduct(Missing(model_.Positions(code_of(numbers), points_), targets));
      },
      .derivative = [&](const Eigen::VectorXd& numbers) -> Eigen::MatrixXd {
        const Eigen::VectorXd code = code_of(numbers);
        if (is_first ? !IsNear(code) : code != derivative_code_) Linearise(code);
        is_first = false;
        return weights.asDiagonal() * derivative_;
      },
      .prior_weights = Eigen::VectorXd::Ones(std::ssize(free_)),
      .prior_mean = first_code_(free_),
      .least_fall = kLeastFall};
  const auto judged = [&](const Eigen::VectorXd& code, const Eigen::VectorXd& positions) {
    return Judged(code, Missing(positions, targets), move, deviations);
  };
  const bool helps =
      judged(start, model_.Positions(start, points_)).energies.front() < judged(code_, positions_).energies.front();
  Minimum minimum = Minimise(energy, (helps ? start : code_)(free_), options_.steps);
  code_ = code_of(minimum.x);
  positions_ = model_.Positions(code_, points_);
  HandleEdit edit = judged(code_, positions_);
  edit.energies = std::move(minimum.energies);
  return edit;
}

HandleEdit HandleEditor::Hold(double move, Deviations& deviations,
                              const std::function<HandleEdit(const Deviations&)>& solve) const {
  const auto is_held = [&](const HandleEdit& edit) {
    return options_.deviation_cm || edit.residual_share <= kHeldShare;
  };
  const auto hold = [&](Deviations& tried) {
    HandleEdit edit = solve(tried);
    while (!is_held(edit) && tried.handle > kLeastHandleShare * move) {
      tried.handle *= HoldingFactor(edit.residual_share);
      edit = solve(tried);
    }
    return edit;
  };
  HandleEdit best = hold(deviations);
  const double least_outside = kLeastOutsideShare * move * OutsideRoot();
  while (num_outside() > 0 && is_held(best) && best.outside_share > options_.most_leakage &&
         deviations.outside > least_outside) {
    Deviations tried = deviations;
    tried.outside *= kFall;
    HandleEdit edit = hold(tried);
    if (!is_held(edit)) break;
    deviations = tried;
    best = std::move(edit);
  }
  return best;
}

HandleEdit HandleEditor::MoveTo(const geometry::Points& targets) {
  DAUMIER_CHECK(targets.rows() == places_.rows(), "{} targets of {} handles", targets.rows(), places_.rows());
  DAUMIER_CHECK(targets.allFinite(), "a handle's target is not finite");
  const double move = (targets - places_).rowwise().norm().maxCoeff();
  if (move == 0) {
    code_ = first_code_;
    positions_ = first_positions_;
    return {.code = code_, .energies = {0}};
  }
  if (!IsNear(code_)) Linearise(code_);
  Deviations deviations{options_.deviation_cm.value_or(kFirstHandleShare * move),
                        kFirstOutsideShare * move * OutsideRoot()};
  HandleEdit edit = Hold(move, deviations, [&](const Deviations& tried) { return Predict(targets, move, tried); });
  if (!model_.is_linear()) {
    Eigen::VectorXd start = edit.code;
    edit = Hold(move, deviations, [&](const Deviations& tried) {
      HandleEdit refined = Refine(targets, move, tried, start);
      start = refined.code;
      return refined;
    });
  }
  return edit;
}

HandleEdit EditByHandles(const CodeModel& model, const Eigen::VectorXd& code, const std::vector<int>& handles,
                         const geometry::Points& displacements, const HandleOptions& options) {
  HandleEditor editor(model, code, handles, options);
  return editor.MoveBy(displacements);
}

}  // namespace daumier::fitting
