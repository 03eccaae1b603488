#pragma once
#include "datasets/styles/polylines.h"

#include <vector>

namespace daumier::sketch {

using CanvasPoints = datasets::Polyline;

/// A line, and how wide it is drawn.
struct PenLine {
  CanvasPoints points;
  /// One a point, in the unit of the points; 0, or no widths at all: as lines of the canvas are.
  std::vector<double> widths = {};
};

PenLine Reversed(const PenLine& line);
/// The lines end to end.
PenLine Joined(const PenLine& first, const PenLine& second);
/// The line with points at most `step` apart; widths between two points change evenly. @throws Error if it has no point.
PenLine Densified(const PenLine& line, double step);
/// The width at a share (0 to 1) of the line's length; 0 without widths.
double WidthAtShare(const PenLine& line, double share);

}  // namespace daumier::sketch
