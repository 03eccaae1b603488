#pragma once
#include "systems/sketch/session_curves.h"

#include <vector>

/// What becomes of a pen's path before it is a stroke. Lengths are pixels of the sheet.
namespace daumier::sketch {

/// How a stroke is drawn.
struct Pen {
  bool mirror = false;    ///< Its image on the other side of the face is drawn, too.
  double stabiliser = 0;  ///< Length of the string by which the pen pulls the line; 0: the pen draws itself.
};

/// Longest string, pixels of the sheet.
inline constexpr double kLongestString = 1'000;

/// The line that a pen pulls behind it on a string: a point q that stays while the pen p is within the string's length s,
/// and else moves to p + s (q - p) / |q - p|. Tremor shorter than s vanishes, corners become round. Where the pen is
/// lifted, the line runs on to it. The path is divided into steps of at most s / 8, so that the line does not depend on
/// how often the pen was sampled. @throws Error if a point is not finite, there is none, or s is not from 0 to
/// kLongestString.
CanvasPoints Stabilised(const CanvasPoints& path, double string);

/// The line on the other side of the vertical x = axis.
CanvasPoints Mirrored(CanvasPoints line, double axis);

/// What a pen with mirror draws: the line and its image. If one end of the line lies within `reach` of the axis, both are
/// one line, which crosses the axis there; if both ends do, one closed line. A line that is its own image within `reach` is drawn once.
std::vector<CanvasPoints> WithMirrorImage(const CanvasPoints& line, double axis, double reach);

}  // namespace daumier::sketch
