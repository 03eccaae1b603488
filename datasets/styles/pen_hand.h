#pragma once
#include "core/random.h"
#include "datasets/styles/style_options.h"
#include "datasets/styles/styled_drawing.h"
#include "datasets/styles/styled_lines.h"

#include <vector>

namespace daumier::datasets {

/// The habits of a hand in one drawing. Lengths in pixels of the canvas.
struct HandHabits {
  double width = 1.5;
  double tremor = 0, tremor_length = 14, bend = 0;
  double doubled = 0, searching = 0, gaps = 0;  ///< Shares of the lines.
  double overshoot = 0;                         ///< Standard deviation at each end.
  double polygon = 0;  ///< Greatest distance of a line from its straight pieces; 0: lines are smooth.
};

/// Draws the habits of a drawing; `size` is the eye span on the canvas over that of a drawing that fills it: small
/// drawings have small errors.
HandHabits DrawHabits(const HandStyles& styles, bool is_steady, double size, Rng& rng);

/// The lines bent as wholes, on the canvas: anchors move with them.
void BendLines(LineSheet& sheet, double bend, Rng& rng);

/// The strokes of a hand along a line, cut at the border of the canvas; none if all of it lies outside.
/// Promises: each stroke stays within 3.5 px + 2 * polygon + overshoot of the line; a line whose care is kMark is one
/// stroke.
std::vector<StyledStroke> DrawByHand(const StyledLine& line, const HandHabits& habits, Rng& rng);

}  // namespace daumier::datasets
