#pragma once
#include "render/strokes.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace daumier::fitting {

/// A straight piece of a drawn stroke.
struct Segment {
  Eigen::Vector2f from, to;
  Eigen::Vector2f direction;  ///< Of length 1; 0 where the piece is one point.

  Eigen::Vector2f Nearest(const Eigen::Vector2f& point) const;
};

/// Of length 1; the zero vector stays what it is.
Eigen::Vector2f Unit(const Eigen::Vector2f& vector);

/// All pieces of the strokes in their order; one point alone is a piece without length.
std::vector<Segment> SegmentsOf(const std::vector<render::Stroke>& strokes);

/// Segments by the cells of a grid over the canvas, so that those within reach of a point are found at once.
class SegmentGrid {
 public:
  /// @throws Error if the reach, in pixels of the canvas, is not positive.
  SegmentGrid(std::vector<Segment> segments, float reach);

  /// The nearest point that is nearer than `reach`, at most the constructor's, on a segment whose direction (to either
  /// side) has at least this cosine with the given one.
  std::optional<Eigen::Vector2f> Nearest(const Eigen::Vector2f& point, const Eigen::Vector2f& direction, float reach,
                                         float least_cosine) const;

 private:
  /// One cell of margin on each side takes all that lies outside.
  int Cell(float coordinate) const;

  float reach_, cell_;
  int side_ = 0;
  std::vector<Segment> segments_;
  std::vector<std::vector<int>> cells_;
};

}  // namespace daumier::fitting
