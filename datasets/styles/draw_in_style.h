#pragma once
#include "datasets/styles/face_shape.h"
#include "datasets/styles/style_options.h"
#include "datasets/styles/styled_drawing.h"

namespace daumier::datasets {

/// A drawing of a face as a person might make it: the lines of the shape in styles that `options` weighs, with what is
/// drawn around a face, in the frame of the canvas. Turned faces and profiles are never doodles; of profiles half are
/// mirrored, and their pose is that of the mirrored sheet.
/// Promises: the same shape, options and state of `rng` give the same drawing; those of StyledDrawing; there is a
/// stroke.
StyledDrawing DrawInStyle(const FaceShape& shape, const StyleOptions& options, Rng& rng);

}  // namespace daumier::datasets
