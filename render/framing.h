#pragma once
#include "render/drawing.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <vector>

namespace daumier::render {

struct FrameOptions {
  double curve_height = 0.62;  ///< Height of the drawing on the canvas, as a share of its side.
  double max_width =
      0.8;  ///< Greatest width, as a share of the canvas's side; the drawing gets smaller than curve_height for it.
};

/// Scale and shift of a sheet on the canvas: p_canvas = scale * p_sheet + shift.
struct Placement {
  double scale = 1.0;
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
};

std::vector<Stroke> MapToCanvas(const std::vector<Stroke>& strokes, const Placement& placement);

/// A drawing without marks that do not belong to it, and its placement.
struct FramedDrawing {
  std::vector<Stroke> strokes;  ///< In the sheet's own pixels.
  Eigen::AlignedBox2d box;      ///< Of these strokes, on the sheet.
  Placement placement;
};

/// The drawing on the canvas of kSketchCanvas by one scale and a shift: the centre of its bounding box comes to the
/// centre of the canvas, its height to curve_height of the canvas, or its width to max_width if it would be wider.
/// Strokes far outside all others (dirt, a signature) are left out and do not count for the box.
/// @throws Error if there are no points, all are one point, or a coordinate is not finite.
FramedDrawing FrameDrawing(const Drawing& drawing, const FrameOptions& options = {});
/// The strokes of FrameDrawing in their place on the canvas.
std::vector<Stroke> FrameStrokes(const Drawing& drawing, const FrameOptions& options = {});

}  // namespace daumier::render
