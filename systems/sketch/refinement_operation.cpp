#include "systems/sketch/refinement_operation.h"

#include "core/error.h"

namespace daumier::sketch {

using What = RefinementOperation::What;

RefinementState Apply(const RefinementOperation& operation, const Refinement& refinement, const RefinementState& state,
                      const render::Camera& camera) {
  const auto& [what, points, view, radius, level] = operation;
  switch (what) {
    case What::kRegion:
      return refinement.Region(state, camera, points);
    case What::kBrush:
      return refinement.Brush(state, camera, points, radius);
    case What::kUnbrush:
      return refinement.Erase(state, camera, points, radius);
    case What::kTranslate:
      return refinement.Translate(state, camera, points);
    case What::kRoll:
      return refinement.Roll(state, camera, level);
    case What::kPull:
      return refinement.PullSilhouette(state, camera, points);
  }
  throw Error("an unknown operation");
}

std::optional<RefinementOperation> OperationOf(datasets::Gesture gesture, const CanvasPoints& stroke, const View& view,
                                               bool has_handles) {
  using enum datasets::Gesture;
  switch (gesture) {
    case kRegion:
      return RefinementOperation{What::kRegion, stroke, view};
    case kLine:
      return RefinementOperation{has_handles ? What::kTranslate : What::kPull, stroke, view};
    case kUpRoll1:
    case kUpRoll2:
    case kUpRoll3:
      return RefinementOperation{.what = What::kRoll, .view = view, .level = 1 + int(gesture) - int(kUpRoll1)};
    case kDownRoll1:
    case kDownRoll2:
    case kDownRoll3:
      return RefinementOperation{.what = What::kRoll, .view = view, .level = -1 - int(gesture) + int(kDownRoll1)};
    case kLeftArrow:
    case kRightArrow:
    case kNone:
      return std::nullopt;
  }
  throw Error("an unknown gesture");
}

}  // namespace daumier::sketch
