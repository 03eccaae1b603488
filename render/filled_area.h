#pragma once
#include "render/image.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <vector>

namespace daumier::render {

/// Where a point is inside of outlines that overlap [SVG 1.1, 11.3]: where their winding number is not 0, or where it
/// is odd.
enum class FillRule { kNonzero, kEvenOdd };

/// The inside of all outlines together. An outline is closed by the line from its last point to its first.
struct FilledArea {
  std::vector<std::vector<Eigen::Vector2d>> outlines;
  FillRule rule = FillRule::kNonzero;

  Eigen::AlignedBox2d Box() const;  ///< Of all points; empty if there is none.
};

/// Pixels of a mask over the plane: p_in_mask = scale (p - origin).
struct MaskFrame {
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();
  double scale = 1.0;  ///< Pixels a unit.
};

/// Sets the pixels of a mask of one channel whose centres are inside the area to a value. What lies beyond the mask is
/// cut off. Middle lines need centres alone: cv::fillPoly, which SvgCanvas fills with, also sets every pixel that an
/// outline touches, which widens thin pens and closes gaps. O(pixels set + rows crossed by edges).
/// @throws Error if the mask has more than one channel or a point is not finite.
void FillArea(const FilledArea& area, const MaskFrame& frame, uint8_t value, Image& mask);

}  // namespace daumier::render
