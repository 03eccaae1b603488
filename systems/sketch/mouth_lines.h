#pragma once
#include "systems/sketch/drawing_parser.h"

#include <array>
#include <optional>

/// A mouth by the lines that cuts across it meet. Networks take the lower half of a closed mouth for an opening where people
/// draw the outline of both lips and the line between them; three lines decide that, four are lips and an opening.
namespace daumier::sketch {

/// Shares of the way from the right corner of the mouth to the left one at which it is cut, at right angles.
inline constexpr std::array<double, 9> kMouthCuts = {0.3, 0.35, 0.4, 0.45, 0.5, 0.55, 0.6, 0.65, 0.7};

/// The lines of a closed mouth, upper lip, middle and lower lip: how far below the line of its corners each cut meets them, in
/// widths of the mouth. NaN where a cut does not meet three lines.
using ThreeMouthLines = std::array<std::array<double, 3>, kMouthCuts.size()>;

/// Present where a mouth is drawn closed by three lines: cuts meet lines with a label of the mouth, lines that are nearer
/// than kSameLine being one, and
///   no cut meets more than three lines, at least six meet three;
///   the middle one is level with the corners, -0.10 to 0.16 widths below them, and 15 to 65 % of the way down;
///   the outer ones are labelled as upper and lower lip, or the upper one is 0.06 widths above the corners and the middle one
///   at most 0.08 below them: an opening begins at its corners.
/// The numbers were chosen on styled drawings. There 133 of 149 such mouths are closed.
std::optional<ThreeMouthLines> FindThreeMouthLines(const ParsedDrawing& drawing);

/// A drawing with three lines of a closed mouth, unless its network finds teeth: closed with a probability of at least
/// kClosedByLines, the inner points where the middle line is, each line with its own label. Others are unchanged.
void ReadMouthLines(ParsedDrawing& drawing);

inline constexpr double kSameLine = 0.8;  ///< Pixels of the canvas of drawing.frame.
inline constexpr double kClosedByLines = 0.89;

}  // namespace daumier::sketch
