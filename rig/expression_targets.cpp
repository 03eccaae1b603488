#include "rig/expression_targets.h"

#include "rig/arkit_names.h"

#include <algorithm>

namespace daumier::rig {
namespace {

/// Transfer of one expression a column of `shapes`.
faces::ExpressionTransfer TransferOf(const faces::FaceTemplate& face_template, const Eigen::MatrixXf& shapes) {
  faces::FaceModel shown;
  shown.face_template = face_template;
  shown.expression_shapes = shapes;
  for (int e = 0; e < kNumArkitNames; ++e)
    shown.expressions.push_back({std::string(ArkitNames()[size_t(e)]), Eigen::VectorXf::Unit(kNumArkitNames, e)});
  return {shown, shown.expressions};
}

geometry::Points PoseOf(const faces::FaceTemplate& face_template, const Eigen::MatrixXf& shapes,
                        std::string_view name) {
  geometry::Points pose = face_template.neutral;
  Eigen::Map<Eigen::VectorXd>(pose.data(), pose.size()) += shapes.col(*FindArkitName(name)).cast<double>();
  return pose;
}

/// Transfer solves for all vertices at once, and moves by a little what is far from what moves.
void RemoveDrift(Eigen::MatrixXf& offsets) {
  constexpr float kDriftCm = 0.005f;
  for (Eigen::Index t = 0; t < offsets.cols(); ++t) {
    for (Eigen::Index v = 0; v < offsets.rows() / 3; ++v) {
      auto offset = offsets.col(t).segment<3>(3 * v);
      const float length = offset.norm();
      if (length < 2 * kDriftCm) offset *= std::max(0.0f, length / kDriftCm - 1);
    }
  }
}

}  // namespace

ExpressionTargets::ExpressionTargets(const faces::FaceModel& model)
    : ExpressionTargets(model.face_template, ArkitShapesOf(model)) {}

ExpressionTargets::ExpressionTargets(const faces::FaceTemplate& face_template, const SourceShapes& source)
    : warnings_(source.warnings),
      transfer_(TransferOf(face_template, source.shapes)),
      contact_(face_template, PoseOf(face_template, source.shapes, "eyeBlinkRight"),
               PoseOf(face_template, source.shapes, "eyeBlinkLeft")) {}

MorphTargets ExpressionTargets::On(const geometry::Points& neutral, unsigned threads) const {
  MorphTargets targets{{ArkitNames().begin(), ArkitNames().end()}, transfer_.Offsets(neutral, threads)};
  RemoveDrift(targets.offsets);
  contact_.Apply(neutral, targets, threads);
  return targets;
}

}  // namespace daumier::rig
