#pragma once
#include "datasets/styles/styled_drawing.h"
#include "render/image.h"
#include "render/strokes.h"

#include <vector>

namespace daumier::datasets {

/// How a drawing is shown: with its own pens and black areas, or as a program reads it that traces drawings: all lines
/// of one width, areas as their outlines (render::TraceLineDrawing).
enum class PenView { kAsDrawn, kTraced };

/// Black on white, size x size, one channel. `traced_width`: pixels of the 256 canvas.
render::Image RasteriseDrawing(const StyledDrawing& drawing, int size, PenView view, double traced_width = 1.5);

/// The strokes as those of a traced drawing: Stroke::kind is the LineLabel, a stroke for each run of one label.
std::vector<render::Stroke> LabelledStrokes(const StyledDrawing& drawing);

/// The label of a pixel without ink.
inline constexpr int8_t kNoLineLabel = -1;

/// side x side, row-major: of each cell that a stroke passes through the LineLabel of the stroke that passes nearest to
/// its middle, of equally near ones of the first; kNoLineLabel elsewhere.
std::vector<int8_t> RasteriseLabels(const StyledDrawing& drawing, int side);

/// Strokes of the 256 canvas whose kind is a LineLabel, in the colours of these; size x size, RGB.
render::Image ColouredStrokes(const std::vector<render::Stroke>& labelled, int size);

/// The traced lines in the colours of their labels and the points that are shown, RGB, for pictures.
render::Image ColouredDrawing(const StyledDrawing& drawing, int size);

}  // namespace daumier::datasets
