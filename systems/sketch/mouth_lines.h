#pragma once
#include "systems/sketch/drawing_parser.h"

#include <array>
#include <optional>

/// A mouth by the lines that cuts across it meet. Networks take the lower half of a closed mouth for an opening where people
/// draw the outline of both lips and the line between them; three lines decide that, four are lips and an opening. And they
/// take flat lips for an opening, where people draw the outline alone.
namespace daumier::sketch {

/// Shares of the way from the right corner of the mouth to the left one at which it is cut, at right angles.
inline constexpr std::array<double, 9> kMouthCuts = {0.3, 0.35, 0.4, 0.45, 0.5, 0.55, 0.6, 0.65, 0.7};

/// The lines of a closed mouth, upper lip, middle and lower lip: how far below the line of its corners each cut meets them, in
/// widths of the mouth. NaN where a cut meets fewer or more lines.
using ClosedMouthLines = std::array<std::array<double, 3>, kMouthCuts.size()>;

/// Present where a mouth is drawn closed, by three lines or by the outline of its lips alone: cuts meet lines with a label of
/// the mouth, lines that are nearer than kSameLine being one, and
///   no cut meets more than three lines, at least six meet three;
///   the middle one is level with the corners, -0.10 to 0.16 widths below them, and 15 to 65 % of the way down;
///   the outer ones are labelled as upper and lower lip, or the upper one is 0.06 widths above the corners and the middle one
///   at most 0.08 below them: an opening begins at its corners;
/// or
///   no cut meets more than two lines, at least seven meet two;
///   the upper one is 0.06 widths above the corners, and the lines are 0.1 to 0.3 widths apart at most. The middle line is
///   then taken to be 45 % of the way down.
/// The numbers were chosen on styled drawings (docs/results/drawings.md).
std::optional<ClosedMouthLines> FindClosedMouthLines(const ParsedDrawing& drawing);

/// A drawing with the lines of a closed mouth, unless its network finds teeth: closed with a probability of at least
/// kClosedByLines, the inner points where the middle line is, each line with its own label. Others are unchanged.
void ReadMouthLines(ParsedDrawing& drawing);

inline constexpr double kSameLine = 0.8;  ///< Pixels of the canvas of drawing.frame.
inline constexpr double kClosedByLines = 0.89;

}  // namespace daumier::sketch
