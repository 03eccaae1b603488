#pragma once
#include "datasets/styles/polylines.h"

#include <span>

namespace daumier::datasets {

/// The picture of a stroke that a network reads.
struct GestureRaster {
  int side = 64;        ///< Pixels.
  double width = 1.5;   ///< Of the line, pixels.
  bool binary = false;  ///< Ink or paper; otherwise a pixel has the share that the line covers.
};

/// The stroke's bounding box centred, its longer side all but kRasterMargin of the picture's side at each border, its
/// aspect kept; ink 1, paper 0, side x side, row 0 on top. Place, size and direction of the pen do not matter.
/// @throws Error if the picture has another size, the stroke fewer than two points, a coordinate that is not finite, or
/// no extent.
void RasteriseGesture(const Polyline& stroke, const GestureRaster& raster, std::span<float> picture);

inline constexpr double kRasterMargin = 0.06;

}  // namespace daumier::datasets
