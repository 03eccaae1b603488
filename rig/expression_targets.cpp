#include "rig/expression_targets.h"

#include "rig/arkit_names.h"
#include "rig/source_shapes.h"

namespace daumier::rig {
namespace {

/// Transfer of one expression a column of `shapes`.
faces::ExpressionTransfer TransferOf(const faces::FaceModel& model, const Eigen::MatrixXf& shapes) {
  faces::FaceModel shown{.face_template = model.face_template,
                         .identity_shapes = {},
                         .identity_controls = {},
                         .expression_shape_names = {},
                         .expression_shapes = shapes,
                         .expressions = {}};
  for (Eigen::Index e = 0; e < shapes.cols(); ++e) {
    shown.expression_shape_names.emplace_back(ArkitNames()[size_t(e)]);
    shown.expressions.push_back({shown.expression_shape_names.back(), Eigen::VectorXf::Unit(shapes.cols(), e)});
  }
  return {shown, shown.expressions};
}

}  // namespace

ExpressionTargets::ExpressionTargets(const faces::FaceModel& model)
    : transfer_([&] {
        const SourceShapes source = ArkitShapesOf(model);
        warnings_ = source.warnings;
        return TransferOf(model, source.shapes);
      }()) {}

MorphTargets ExpressionTargets::On(const geometry::Points& neutral, unsigned threads) const {
  return {{ArkitNames().begin(), ArkitNames().end()}, transfer_.Offsets(neutral, threads)};
}

}  // namespace daumier::rig
