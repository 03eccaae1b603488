#pragma once
#include "render/filled_area.h"
#include "render/strokes.h"

#include <vector>

namespace daumier::render {

enum class Paint { kInk, kPaper };

/// A filled area without a stroke, as a vector drawing has it. Its points are in pixels of the sheet.
struct PaintedArea {
  FilledArea shape;
  Paint paint = Paint::kInk;
  int kind = 0;  ///< Of its strokes.
  /// The lines from which the program that wrote the drawing made the area; empty where it does not say.
  std::vector<std::vector<Eigen::Vector2d>> drawn_lines;
};

/// Thickness of a small piece that may count as one of the pen's, in widths of the pen: twice that of HollowAreas.
constexpr double kMaxDotWidths = 2.4;

enum class PieceShape { kLine, kCompact };

/// A connected piece of ink, in pixels of the sheet.
struct AreaPiece {
  PieceShape shape = PieceShape::kCompact;
  double width = 0.0;                     ///< That 90 % of its skeleton do not exceed.
  double pen_width = 0.0;                 ///< The median along its skeleton.
  double length = 0.0;                    ///< Of its skeleton.
  std::vector<Stroke> lines;              ///< Its middle lines, kind 0; none where it is compact and wider than a dot.
  std::vector<Stroke> outlines;           ///< The outlines of ink on its edge, kind 0.
  std::vector<const PaintedArea*> areas;  ///< To which these outlines belong.
};

/// The pieces of areas that are painted one after the other, ink and paper. A piece is a line if it is long and thin,
/// area >= 4 width^2 and width <= max_width, or if most of it is lines that hang on something thicker; the thicker part
/// is then hollowed out (HollowAreas). The areas are rasterised at 12 pixels a pen's width, at most 2048 on the longer
/// side. Areas without an inside, or narrower than a pixel, have no pieces.
/// @throws Error if a point is not finite.
std::vector<AreaPiece> FindAreaPieces(const std::vector<const PaintedArea*>& layers, double max_width);

/// Twice the inside of the outlines over their length: the width of a long line, in pixels. 0 without an inside.
double RoughWidth(const FilledArea& area);

/// An estimate of the number of pixels that FindAreaPieces needs for an area.
double NumPixelsFor(const FilledArea& area);

/// Polylines as strokes of kind 0.
std::vector<Stroke> StrokesThrough(const std::vector<std::vector<Eigen::Vector2d>>& polylines);

}  // namespace daumier::render
