#pragma once
#include "render/image.h"

#include <cmath>
#include <vector>

namespace daumier::render {

/// A straight line near the rows of a picture: y cos(angle) - x sin(angle) = v, with x to the right and y downwards from
/// the middle of the picture, in pixels.
struct RuledLine {
  double angle = 0.0, v = 0.0;
  double cover = 0.0;  ///< Share of its length that is dark.
  double RowAt(double x) const { return (v + x * std::sin(angle)) / std::cos(angle); }
};

/// The lines of a mask that is 255 where something is dark: dark on most of their length from border to border, all at
/// the angle, of 15 degrees at most, at which they are darkest; from the first to the last row. None of a mask that is
/// dark everywhere.
std::vector<RuledLine> LinesNearRows(const Image& mask);

/// The most of the lines that are at one distance, or at multiples of it, from the next one; none if these are fewer
/// than five. At most two in a row may be missing.
std::vector<RuledLine> RegularLines(const std::vector<RuledLine>& lines);

}  // namespace daumier::render
