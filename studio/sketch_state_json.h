#pragma once
#include "core/json.h"
#include "systems/sketch/sketch_session.h"

namespace daumier::studio {

/// What the page shows of a state, lengths in pixels of the sheet:
///   {mode: "draw", "follow_up" or "refine", has_face, lines: [{kind: "stroke", "curve" or "wrinkle", points: [[x, y], ...],
///   width, widths?: one a point}, ...], open_ends: [[[x, y], [x, y]], ...], snap_reach, eraser_reach, handles: [vertex, ...],
///   region: [vertex, ...], warnings: [...]}
/// open_ends: of each gap of a curve sketch::EndsOfGap. region: none of the whole mesh.
Json SketchStateJson(const sketch::SketchState& state);

}  // namespace daumier::studio
