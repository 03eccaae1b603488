#pragma once
#include "render/framing.h"

#include <vector>

/// Strokes that a pen drew with a weight of its own. Pictures and files show it; networks read plain strokes.
namespace daumier::render {

struct WeightedStroke : Stroke {
  /// Width at each point, in the unit of the points; 0, or no widths at all: that of StrokeStyle.
  std::vector<float> widths;
};

/// A part of a stroke that is drawn with one width.
struct StrokePart {
  Stroke stroke;
  double width = 0;
};

/// Greatest step of the width from one part to the next, where a segment needs no more than kMostPartsOfSegment.
inline constexpr double kWidthStep = 0.25;
inline constexpr int kMostPartsOfSegment = 16;

/// The parts of a stroke on the canvas, end to end. A segment along which the width changes is divided into equal pieces, each as
/// wide as its middle, rounded to kWidthStep and at least that; pieces of equal width are one part. A stroke of one width
/// is one part, whose width is not rounded. @throws Error if there are widths, but not one a point, or one is negative or not finite.
std::vector<StrokePart> PartsByWidth(const WeightedStroke& stroke);

/// As MapToCanvas, with the widths.
std::vector<WeightedStroke> MapWeighted(std::vector<WeightedStroke> strokes, const Placement& placement);

/// As RasteriseStrokes, each stroke by its widths. @throws Error as RasteriseStrokes and PartsByWidth.
Image RasteriseWeighted(const std::vector<WeightedStroke>& strokes, int size);

}  // namespace daumier::render
