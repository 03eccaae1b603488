#pragma once
#include "core/json.h"
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

/// Similarity of a sheet and the canvas: p_canvas = scale * R * p_sheet + shift with R = (cos a, -sin a; sin a, cos a),
/// a = turn_degrees. x is to the right and y down, so that a positive turn is clockwise.
struct Placement {
  double scale = 1.0;
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
  double turn_degrees = 0.0;

  bool operator==(const Placement&) const = default;
};
/// The placement with scale R = (a, -b; b, a).
Placement PlacementFrom(double a, double b, const Eigen::Vector2d& shift);
/// scale R
Eigen::Matrix2d LinearPart(const Placement& placement);

Eigen::Vector2d ToCanvas(const Placement& placement, const Eigen::Vector2d& p_in_sheet);
/// Undoes ToCanvas.
Eigen::Vector2d ToSheet(const Placement& placement, const Eigen::Vector2d& p_in_canvas);
/// The placement whose ToCanvas is ToSheet of this one.
Placement Inverse(const Placement& placement);
/// First `inner`, then `outer`.
Placement Composed(const Placement& outer, const Placement& inner);
/// ToCanvas of every point.
std::vector<Stroke> MapToCanvas(const std::vector<Stroke>& strokes, const Placement& placement);

/// For manifests of predictions: {scale, shift (2), turn_degrees}; a turn of 0 is left out.
Json PlacementToJson(const Placement& placement);
/// Undoes PlacementToJson. @throws Error if scale or shift is missing or no number, or the scale is not positive.
Placement PlacementFromJson(const Json& json);

/// For manifests, of a drawing with picture_from_sheet: three rows of three numbers.
Json HomographyToJson(const Eigen::Matrix3d& homography);
/// Undoes HomographyToJson. @throws Error if it is malformed or singular.
Eigen::Matrix3d HomographyFromJson(const Json& json);

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
