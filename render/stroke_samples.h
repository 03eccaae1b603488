#pragma once
#include "render/strokes.h"

#include <vector>

namespace daumier::render {

/// A point on a drawing and the line through it, without the sense in which it was drawn.
struct StrokeSample {
  float x = 0, y = 0;                    ///< Pixels of the canvas.
  float cos_double = 1, sin_double = 0;  ///< Of twice the line's angle to the x axis, so that both senses agree.
};

/// `count` points at equal distances along all strokes, laid end to end in their order: the i-th lies at length
/// (i + 1/2) / count of the whole. Strokes of one point have no length and are skipped.
/// @throws Error if count is not positive or no stroke has a length.
std::vector<StrokeSample> SampleStrokes(const std::vector<Stroke>& strokes, int count);

/// SampleStrokes as networks read it, 4 x count numbers row by row: x and y from -1 to 1 over the canvas, cos_double,
/// sin_double.
std::vector<float> SampleRows(const std::vector<Stroke>& strokes, int count);

}  // namespace daumier::render
