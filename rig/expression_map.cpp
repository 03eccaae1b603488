#include "rig/expression_map.h"

#include "core/error.h"
#include "core/parallel.h"
#include "geometry/normals.h"
#include "rig/arkit_names.h"
#include "rig/weight_limits.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace daumier::rig {
namespace {

Eigen::VectorXd FaceAreas(const faces::FaceTemplate& face) {
  const Eigen::VectorXd areas = geometry::VertexAreas({face.neutral, face.triangles});
  Eigen::VectorXd masses = Eigen::VectorXd::Zero(areas.size());
  for (const int v : faces::RegionFor(face.annotation, "face", "a map of expressions")) masses[v] = areas[v];
  return masses;
}

double GainOf(const WeightSolver& solver, const Eigen::VectorXd& displacement, const Eigen::VectorXd& weights) {
  const Eigen::VectorXd shown = solver.Displacement(weights);
  double product = 0, square = 0;
  for (Eigen::Index i = 0; i < solver.masses().size(); ++i) {
    const Eigen::Index v = 3 * solver.vertices()[size_t(i)];
    const Eigen::Vector3d wanted = displacement.segment<3>(v), own = shown.segment<3>(v);
    const double mass = solver.masses()[i] * wanted.squaredNorm();
    product += mass * own.dot(wanted);
    square += mass * own.squaredNorm();
  }
  return square > 0 ? std::clamp(product / square, 1.0, kMostGain) : 1;
}

}  // namespace

std::optional<double> MappedExpression::explained() const {
  if (no_motion.rms_cm == 0) return std::nullopt;
  const double ratio = error.rms_cm / no_motion.rms_cm;
  return 1 - ratio * ratio;
}

ExpressionMap MapExpressions(const ModelExpressions& model, const MorphTargets& targets) {
  const Eigen::Index num_expressions = model.shapes.cols();
  const bool is_signed = model.kind == CoefficientKind::kSigned;
  ExpressionMap map{.expressions = model.names,
                    .kind = model.kind,
                    .constant = model.constant,
                    .positive = {},
                    .negative = {},
                    .model = model.face_template.provenance,
                    .targets = {}};
  map.mm_per_cm = faces::MillimetresPerCm(model.face_template);
  map.positive = Eigen::MatrixXf::Zero(num_expressions, kNumArkitNames);
  map.negative = Eigen::MatrixXf::Zero(is_signed ? num_expressions : 0, kNumArkitNames);
  map.mapped.resize(size_t(num_expressions * (is_signed ? 2 : 1)));
  const WeightSolver solver(
      targets, FaceAreas(model.face_template),
      MostWeights(std::numeric_limits<double>::infinity(), model.has_gaze ? GazeTargets::kUsed : GazeTargets::kZero));
  OnAllCores(std::ssize(map.mapped), [&](int64_t row) {
    const Eigen::Index e = row % num_expressions;
    MappedExpression& mapped = map.mapped[size_t(row)];
    mapped.name = model.names[size_t(e)];
    mapped.is_negative = row >= num_expressions;
    if (mapped.is_negative && model.constant == int(e)) return;
    const Eigen::VectorXd displacement = (mapped.is_negative ? -1 : 1) * model.shapes.col(e).cast<double>();
    const Eigen::VectorXd weights = solver.Solve(displacement);
    mapped.error = solver.ErrorOf(displacement, weights);
    mapped.no_motion = solver.ErrorOf(displacement, Eigen::VectorXd::Zero(kNumArkitNames));
    mapped.gain = GainOf(solver, displacement, weights);
    (mapped.is_negative ? map.negative : map.positive).row(e) = weights.cast<float>();
  });
  return map;
}

ExpressionMap WithKeptStrength(ExpressionMap map) {
  for (size_t row = 0; row < map.mapped.size(); ++row) {
    const MappedExpression& mapped = map.mapped[row];
    (mapped.is_negative ? map.negative : map.positive).row(Eigen::Index(row) % map.num_expressions()) *=
        float(mapped.gain);
  }
  return map;
}

Eigen::MatrixXf WeightsOf(const ExpressionMap& map, const Eigen::MatrixXf& coefficients) {
  DAUMIER_CHECK(coefficients.cols() == map.num_expressions(), "frames have {} coefficients, the map {} expressions",
                coefficients.cols(), map.num_expressions());
  DAUMIER_CHECK(coefficients.allFinite(), "a coefficient is not finite");
  WeightsClip clip;
  clip.names.assign(ArkitNames().begin(), ArkitNames().end());
  clip.weights = coefficients.cwiseMax(0.0f) * map.positive;
  if (map.negative.rows() > 0) clip.weights += (-coefficients).cwiseMax(0.0f) * map.negative;
  clip.weights = clip.weights.cwiseMax(0.0f).cwiseMin(1.0f);
  LimitWeights(clip);
  return clip.weights;
}

}  // namespace daumier::rig
