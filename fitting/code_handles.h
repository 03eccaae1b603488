#pragma once
#include "fitting/code_model.h"
#include "fitting/handle_quadratic.h"

#include <algorithm>
#include <cmath>
#include <functional>
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
  Eigen::VectorXd code;       ///< M
  double residual_share = 0;  ///< Largest distance of a handle from its target, as a share of the largest move.
  double outside_share = 0;   ///< Mean move of `outside` as a share of that; 0 without.
  double deviation_cm = 0;    ///< Used for the handles.
  bool is_usual = true;       ///< |code| is within the model's usual radius, or not larger than before.
  /// Of the last solve, at its start and after each step; never rises. Of a linear model that of the minimum alone.
  std::vector<double> energies;
};

/// The residual of a held handle: at most this share of its move.
inline constexpr double kHeldShare = 0.05;

/// Moves vertices of a face and lets the model move the others [Jung et al. 2022, eq. 4, with squares for the absolute
/// values, which have a dead zone]: the code c of least
///   E(c) = |c - c0|^2 + sum_h |D(c)_h - t_h|^2 / s^2 + sum_o |D(c)_o - D(c0)_o|^2 / s_o^2,
/// t_h the handles' targets, o vertices of `outside`. Only these points are decoded. Without a given deviation s
/// falls from a fifth of the largest move until each handle is within kHeldShare of that; with `outside`, s_o falls
/// until these move by most_leakage at most or the handles no longer hold. All of this happens where positions are
/// taken as linear in the code (HandleQuadratic), which is exact for a linear model. For another one Gauss-Newton steps
/// follow with these deviations, which fall further where they must; the derivative is computed again only where the
/// code has moved by a third of a deviation, with many held points by one, or a step with it is poor. Promises: handles that do not move give c0;
/// energies of a solve never rise; a moved handle is nearer to its target than before.
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
  using Deviations = HandleQuadratic::Deviations;
  /// The edit whose deviations fall until the handles hold and the outside stays; solve: of given deviations.
  HandleEdit Hold(double move, Deviations& deviations, const std::function<HandleEdit(const Deviations&)>& solve) const;
  /// The minimum where positions are linear in the code.
  HandleEdit Predict(const geometry::Points& targets, double move, const Deviations& deviations) const;
  /// By Gauss-Newton steps from code_, or from `start` where that has a lower energy.
  HandleEdit Refine(const geometry::Points& targets, double move, const Deviations& deviations,
                    const Eigen::VectorXd& start);
  /// What positions of points_ lack: targets less handles, and the first positions of the outside less these.
  Eigen::VectorXd Missing(const Eigen::VectorXd& positions, const geometry::Points& targets) const;
  HandleEdit Judged(Eigen::VectorXd code, const Eigen::VectorXd& missing, double move,
                    const Deviations& deviations) const;
  /// The weights of rows of points_ in r of E = |r|^2 + |c - c0|^2.
  Eigen::VectorXd Weights(const Deviations& deviations) const;
  Eigen::Index num_handle_rows() const { return 3 * std::ssize(handles_); }
  Eigen::Index num_outside() const { return std::ssize(points_) - std::ssize(handles_); }
  /// Deviations of the outside are those of its mean square.
  double OutsideRoot() const { return std::sqrt(std::max(1.0, double(num_outside()))); }
  /// Whether the derivative serves this code.
  bool IsNear(const Eigen::VectorXd& code) const;
  void Linearise(const Eigen::VectorXd& code);

  const CodeModel& model_;
  const Eigen::VectorXd first_code_;
  const std::vector<int> handles_;
  const HandleOptions options_;
  std::vector<int> points_;  ///< Handles, then the chosen ones of `outside`.
  std::vector<int> free_;    ///< Numbers of the code that are not fixed.
  geometry::Points places_;
  Eigen::VectorXd first_positions_;           ///< Of points_.
  Eigen::MatrixXd derivative_;                ///< Of points_ by the free numbers,
  Eigen::VectorXd derivative_code_;           ///< and the code where it was computed.
  Eigen::VectorXd base_;                      ///< Of points_ under the first code, as this derivative has it.
  std::optional<HandleQuadratic> quadratic_;  ///< Of this derivative.
  Eigen::VectorXd code_, positions_;          ///< Of the last edit of a model that is not linear.
};

/// One edit: HandleEditor(model, code, handles, options).MoveBy(displacements).
HandleEdit EditByHandles(const CodeModel& model, const Eigen::VectorXd& code, const std::vector<int>& handles,
                         const geometry::Points& displacements, const HandleOptions& options = {});

}  // namespace daumier::fitting
