#pragma once
#include "datasets/styles/drawing_context.h"
#include "datasets/styles/styled_drawing.h"

namespace daumier::datasets {

/// Where a drawing comes to lie on the canvas. Its bounding box fills the canvas up to a margin; or its face does, and
/// hair and shoulders leave it (cropped); or it is smaller (small, off_centre). The face itself stays on the canvas.
render::Placement DrawSheetPose(const LineSheet& sheet, const PageStyles& page, Rng& rng);

}  // namespace daumier::datasets
