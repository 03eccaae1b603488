#pragma once
#include <array>
#include <cstdint>
#include <vector>

namespace daumier::datasets {

/// What a sketch shows apart from its strokes. Points are pixels of the 256 canvas.
struct SketchFacts {
  static constexpr int kLandmarks = 68, kOutline = 96, kNoseContour = 16;
  using Point = std::array<float, 2>;

  std::vector<Point> landmarks;  ///< kLandmarks, iBUG order; also those that are hidden.
  Point hairline;
  /// kOutline: the outer border of face and skull without ears and neck, clockwise from the top, at equal angles about
  /// the middle of its box.
  std::vector<Point> outline;
  /// kNoseContour: the outer border of the nose on the side to which it points, from the bridge to its base.
  std::vector<Point> nose_contour;
  /// Degrees: yaw > 0 looks to the right of the picture, pitch > 0 up, roll > 0 leans to the right.
  float yaw, pitch, roll;
  std::array<float, 3> gaps_mm;       ///< Between the lids of the right and the left eye, and between the lips.
  std::vector<uint8_t> visible = {};  ///< Of each point of the template's curves: 1 seen, 0 hidden behind the face.
};

}  // namespace daumier::datasets
