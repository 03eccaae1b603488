#pragma once
#include "datasets/gestures/gesture.h"
#include "systems/sketch/refinement.h"

#include <optional>

namespace daumier::sketch {

/// An operation of the refinement mode, as a person gives it.
struct RefinementOperation {
  enum class What { kRegion, kBrush, kUnbrush, kTranslate, kRoll, kPull };
  What what = What::kRegion;
  CanvasPoints points = {};  ///< Pixels of the sheet; of kRoll none.
  View view = {};
  double radius = 0;  ///< Of kBrush and kUnbrush, pixels of the sheet.
  int level = 0;      ///< Of kRoll: -3 to 3 without 0.
};

/// camera: of the operation's view, in pixels of the sheet (ViewCamera). @throws Error as the function of Refinement.
RefinementState Apply(const RefinementOperation& operation, const Refinement& refinement, const RefinementState& state,
                      const render::Camera& camera);

/// What a gesture does [Han et al. 2017, section 3.3]: a region sets the region of interest; a line moves the handles, or
/// pulls the silhouette where there are none; a roll of n loops moves the handles along the depth of the view by level
/// n, towards the viewer if it climbs. Nothing for arrows, which undo and redo, and for kNone.
std::optional<RefinementOperation> OperationOf(datasets::Gesture gesture, const CanvasPoints& stroke, const View& view,
                                               bool has_handles);

}  // namespace daumier::sketch
