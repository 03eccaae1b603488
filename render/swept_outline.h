#pragma once
#include "render/strokes.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace daumier::render {

/// The line along which a pen was swept.
struct SweptLine {
  Stroke line;             ///< Kind 0. It ends where the pen did: at the centre of a round cap, at a point, at a butt.
  double width = 0.0;      ///< That 90 % of the line do not exceed.
  double pen_width = 0.0;  ///< The median along the line.
  double length = 0.0;
};

/// The line of an outline that runs along one side of a stroke and back along the other, and covers itself where the
/// stroke does, or whose sides cross where the pen has no width, as those of whiteboards, calligraphy and strokes made
/// paths: such an area does not show its line. Points of the two sides are paired one after the other, the nearest
/// first, from that point of the outline on from which the pairs lie nearest; the line is their middle. Nothing if the
/// outline neither covers nor crosses itself, or is shorter than 3 of its widths. A twig of such an outline has no line
/// of its own. O(n) for n points, for at most 4096 pairs.
/// @throws Error if a point is not finite.
std::optional<SweptLine> LineOfSweptOutline(const std::vector<Eigen::Vector2d>& outline);

}  // namespace daumier::render
