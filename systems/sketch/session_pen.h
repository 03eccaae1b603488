#pragma once
#include "systems/sketch/pen_line.h"

#include <vector>

/// What becomes of a pen's path before it is a stroke. Lengths are pixels of the sheet.
namespace daumier::sketch {

/// How a stroke is drawn.
struct Pen {
  bool mirror = false;    ///< Its image on the other side of the face is drawn, too.
  double stabiliser = 0;  ///< Length of the string by which the pen pulls the line; 0: the pen draws itself.
  double weight = 0;      ///< Width of the line; 0: as wide as lines of the canvas are.
  std::vector<double> pressure = {};  ///< Shares of the weight, 0 to 1, one a point of the path; empty: all of it.
};

/// Longest string, pixels of the sheet.
inline constexpr double kLongestString = 1'000;
/// Share of the weight that a line has without pressure.
inline constexpr double kLeastPressure = 0.05;

/// The path with the pen's widths, weight max(pressure, kLeastPressure). Faces depend on paths alone: widths are for
/// drawings and pictures. @throws Error if the weight is negative or not finite, or the pressure is without a weight,
/// not from 0 to 1, or not one a point.
PenLine WithWeight(const CanvasPoints& path, const Pen& pen);

/// The line that a pen pulls behind it on a string: a point q that stays while the pen p is within the string's length s,
/// and else moves to p + s (q - p) / |q - p|. Tremor shorter than s vanishes, corners become round. Where the pen is
/// lifted, the line runs on to it. The path is divided into steps of at most s / 8, so that the line does not depend on
/// how often the pen was sampled; widths change evenly between the path's points. @throws Error if a point is not finite, there is none, or s is not from 0 to
/// kLongestString.
PenLine Stabilised(const PenLine& path, double string);

/// The line on the other side of the vertical x = axis.
CanvasPoints Mirrored(CanvasPoints line, double axis);

/// What a pen with mirror draws: the line and its image. If one end of the line lies within `reach` of the axis, both are
/// one line, which crosses the axis there; if both ends do, one closed line. A line that is its own image within `reach` is drawn once.
std::vector<PenLine> WithMirrorImage(const PenLine& line, double axis, double reach);

}  // namespace daumier::sketch
