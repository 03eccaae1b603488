#pragma once
#include "render/strokes.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace daumier::render {

/// Strokes as a file has them: x right, y down, in the file's own pixels, of which the sheet is width x height large.
/// Strokes may leave the sheet.
struct Drawing {
  double width = 0.0, height = 0.0;
  std::vector<Stroke> strokes;
  /// Of a sheet that was photographed and rectified: the homography to the pixels of the photograph.
  std::optional<Eigen::Matrix3d> picture_from_sheet = {};
};

}  // namespace daumier::render
