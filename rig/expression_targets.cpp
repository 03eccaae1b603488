#include "rig/expression_targets.h"

#include "core/error.h"
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

MorphTargets ExpressionTargets::Make(const geometry::Points& neutral, const std::vector<bool>& needed,
                                     unsigned threads) const {
  MorphTargets targets{{ArkitNames().begin(), ArkitNames().end()}, transfer_.Offsets(neutral, needed, threads)};
  RemoveDrift(targets.offsets);
  contact_.Apply(neutral, targets, threads);
  return targets;
}

MorphTargets ExpressionTargets::On(const geometry::Points& neutral, unsigned threads) const {
  return Make(neutral, std::vector<bool>(size_t(kNumArkitNames), true), threads);
}

MorphTargets ExpressionTargets::OnlyOn(const geometry::Points& neutral, const std::vector<int>& wanted,
                                       unsigned threads) const {
  std::vector<bool> is_wanted(size_t(kNumArkitNames), false);
  for (const int place : wanted) {
    DAUMIER_CHECK(place >= 0 && place < kNumArkitNames, "{} is no place among {} expressions", place, kNumArkitNames);
    is_wanted[size_t(place)] = true;
  }
  std::vector<bool> needed = is_wanted;
  for (const std::string_view name : FaceContact::Sources()) needed[size_t(*FindArkitName(name))] = true;
  MorphTargets targets = Make(neutral, needed, threads);
  for (size_t e = 0; e < is_wanted.size(); ++e)
    if (!is_wanted[e]) targets.offsets.col(Eigen::Index(e)).setZero();
  return targets;
}

}  // namespace daumier::rig
