#pragma once
#include "fitting/code_model.h"

#include <optional>
#include <vector>

namespace daumier::fitting {

struct HandleOptions {
  /// Deviation of a handle from its target, cm; absent: as small as it takes to hold the handles.
  std::optional<double> deviation_cm = {};
  std::vector<int> outside = {};  ///< Vertices that are to stay: what a local edit must not move.
  double most_leakage = 0.08;     ///< Mean move of `outside` that a local edit aims at, as a share of the handles'.
  std::vector<int> fixed = {};    ///< Numbers of the code that keep their values: the expression.
  int steps = 20;                 ///< Of Gauss-Newton, of each deviation.
};

/// A face with its handles moved.
struct HandleEdit {
  Eigen::VectorXd code;          ///< M
  double residual_share = 0;     ///< Largest distance of a handle from its target, as a share of the largest move.
  double outside_share = 0;      ///< Mean move of `outside` as a share of that; 0 without.
  double deviation_cm = 0;       ///< Used for the handles.
  bool is_usual = true;          ///< |code| is within the model's usual radius, or not larger than before.
  std::vector<double> energies;  ///< Of the last solve, at its start and after each step; never rises.
};

/// The residual of a held handle: at most this share of its move.
inline constexpr double kHeldShare = 0.05;

/// Moves vertices of a face and lets the model move the others [Jung et al. 2022, eq. 4, with squares for the absolute
/// values, which have a dead zone]: the code c of least
///   E(c) = |c - c0|^2 + sum_h |D(c)_h - t_h|^2 / s^2 + sum_o |D(c)_o - D(c0)_o|^2 / s_o^2,
/// t_h the handles' targets, o vertices of `outside`. Only these points are decoded. Without a given deviation s
/// falls from a fifth of the largest move until each handle is within kHeldShare of that; with `outside`, s_o falls
/// until these move by most_leakage at most or the handles no longer hold. Every solve starts at the last code, so
/// that drag sequences are cheap; the derivative is computed again only where the code has moved by a third of a
/// deviation, of a linear model once. Promises: handles that do not move give c0; energies of a solve never rise; a
/// moved handle is nearer to its target than before.
class HandleEditor {
 public:
  /// The model has to outlive it. @throws Error if there is no handle, one is out of range or repeated, a deviation is
  /// not positive, or the code has another size.
  HandleEditor(const CodeModel& model, Eigen::VectorXd code, std::vector<int> handles, HandleOptions options = {});

  /// targets: a row a handle, cm. @throws Error if a shape disagrees or a target is not finite.
  HandleEdit MoveTo(const geometry::Points& targets);
  /// The same by displacements of the handles from where they were first.
  HandleEdit MoveBy(const geometry::Points& displacements) { return MoveTo(places_ + displacements); }

  const geometry::Points& places() const { return places_; }  ///< Of the handles under the first code.

 private:
  struct Deviations {
    double handle, outside;
  };
  HandleEdit Solve(const geometry::Points& targets, const Deviations& deviations);
  /// Of points_ by the numbers that are not fixed; 0 by the others.
  Eigen::MatrixXd Derivative(const Eigen::VectorXd& code);

  const CodeModel& model_;
  const Eigen::VectorXd first_code_;
  const std::vector<int> handles_;
  const HandleOptions options_;
  std::vector<int> points_;  ///< Handles, then the chosen ones of `outside`.
  geometry::Points places_;
  Eigen::VectorXd first_positions_;  ///< Of points_.
  Eigen::MatrixXd derivative_;       ///< Of points_, and the code where it was computed.
  Eigen::VectorXd derivative_code_;
  Eigen::VectorXd code_;  ///< Of the last edit.
};

/// One edit: HandleEditor(model, code, handles, options).MoveBy(displacements).
HandleEdit EditByHandles(const CodeModel& model, const Eigen::VectorXd& code, const std::vector<int>& handles,
                         const geometry::Points& displacements, const HandleOptions& options = {});

}  // namespace daumier::fitting
