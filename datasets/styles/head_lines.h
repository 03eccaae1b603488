#pragma once
#include "datasets/styles/drawing_context.h"

namespace daumier::datasets {

/// How much of the head's border is drawn: all of it, or without the skull, which hair hides or nobody drew.
enum class HeadBorder { kWhole, kOpenTop };

/// Draws the border of face and skull with the chin and, of a face that is not a profile, the points of the contour at
/// the height of the mouth.
void DrawOutline(const DrawingContext& drawing, HeadBorder border);
void DrawEars(const DrawingContext& drawing);
/// Wrinkles, folds, freckles, cheeks.
void DrawSkin(const DrawingContext& drawing);

}  // namespace daumier::datasets
