#pragma once
#include "datasets/read/sketch_database.h"
#include "datasets/styles/styled_drawing.h"
#include "render/image.h"

#include <vector>

namespace daumier::datasets {

/// The drawings of a sheet: those of seed 0 of the first faces on the diagonal of expressions and levels, never picked
/// ones. The database has to have facts.
std::vector<StyledDrawing> DrawingsOfSheet(const SketchDatabase& sketches, int count);

/// 64 of them with their own pens.
render::Image StyledSheet(const SketchDatabase& sketches);
/// The same, traced, in the colours of their labels, with the points and states that they show.
render::Image StyledLabelSheet(const SketchDatabase& sketches);

}  // namespace daumier::datasets
