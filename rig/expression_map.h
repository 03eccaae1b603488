#pragma once
#include "core/json.h"
#include "rig/model_expressions.h"
#include "rig/weight_solver.h"

#include <optional>
#include <string>
#include <vector>

namespace daumier::rig {

/// One end of an expression: how well the targets show it.
struct MappedExpression {
  std::string name;
  bool is_negative = false;     ///< Of coefficient -1.
  DisplacementError error;      ///< Of the weights.
  DisplacementError no_motion;  ///< Of weight 0: the displacement itself.
  double gain = 1;              ///< As WithKeptStrength.

  /// The share of the squared displacement that the weights explain: 1 - (rms of the error / rms of the displacement)^2;
  /// nothing where the expression does not move the face.
  std::optional<double> explained() const;
};

/// Another face model's expression coefficients c as weights of the 52 targets of ArkitNames():
///   w = sum_e max(c_e, 0) positive_e + max(-c_e, 0) negative_e,
/// the negative part of signed coefficients alone; a constant expression counts once. WeightsOf brings w into 0 .. 1.
struct ExpressionMap {
  std::vector<std::string> expressions;  ///< E
  CoefficientKind kind = CoefficientKind::kBlend;
  std::optional<int> constant = {};           ///< As ModelExpressions.
  Eigen::MatrixXf positive;                   ///< E x 52, not negative.
  Eigen::MatrixXf negative;                   ///< E x 52; 0 x 52 unless signed. The constant expression has zeros.
  std::vector<MappedExpression> mapped = {};  ///< E, and of signed ones further rows of the negative ends.
  Json model, targets;    ///< Provenance {name, version, checksum, licence} of the model, of the targets.
  double mm_per_cm = 10;  ///< Of errors that are written.

  int num_expressions() const { return int(expressions.size()); }
};

/// Each end of each expression by least squares on the vertices of the face (region `face`), weighted by their areas:
/// WeightSolver without upper bounds, so that mouthClose <= jawOpen holds for every sum. tongueOut is 0, which no skin
/// shows; so are eyeLook*, which turn the eyes, unless the model has such an expression.
/// targets: the 52 on the vertices of the model's mean face, 3V x 52, cm. On all cores.
/// @throws Error as WeightSolver.
ExpressionMap MapExpressions(const ModelExpressions& model, const MorphTargets& targets);

/// The map with each end of an expression times the gain that brings it nearest to the displacement where that is great:
///   argmin_g sum_v m_v |d_v|^2 |g sum_t w_t o_tv - d_v|^2, 1 <= g <= kMostGain.
/// Least squares keep weights small where a target moves a wider region than the expression does.
ExpressionMap WithKeptStrength(ExpressionMap map);
inline constexpr double kMostGain = 2.5;

/// Weights of frames, N x 52: the sum, clamped to 0 .. 1, then within WeightLimits(). coefficients: N x E.
/// @throws Error if there are not E columns, or a number is not finite.
Eigen::MatrixXf WeightsOf(const ExpressionMap& map, const Eigen::MatrixXf& coefficients);

}  // namespace daumier::rig
