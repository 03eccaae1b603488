#pragma once
#include "datasets/gestures/gesture_strokes.h"
#include "render/image.h"

#include <vector>

namespace daumier::datasets {

/// A stroke, 96 pixels a side.
render::Image PictureOfStroke(const Polyline& stroke);

/// The first strokes of each gesture and of each other kind, a row each, as many as `columns`, drawn as their points
/// joined by straight lines.
render::Image GestureSheet(const std::vector<LabelledStroke>& strokes, int columns = 10);

}  // namespace daumier::datasets
