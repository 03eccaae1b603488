#pragma once
#include "geometry/mesh.h"

#include <array>
#include <string>
#include <vector>

namespace daumier::rig {

/// What the mouth of a face shows that is taken for neutral, by its 68 landmarks, without a unit.
struct RestExpression {
  double lip_gap = 0;  ///< Mean distance of the inner lips (61-67, 62-66, 63-65) over the width of their slit (60-64).
  double corner_rise =
      0;  ///< Height of the corners (48, 54) above the middle of the lips (51, 57) over their distance.
  double mouth_width = 0;  ///< Distance of the corners over that of the outer corners of the eyes (36-45).
};

/// Beyond these a mouth is open, or smiles. Of 2000 random persons of the shipped model none is open, one smiles
/// (docs/results/rigging.md).
inline constexpr double kOpenAtRest = 0.13, kRaisedAtRest = 0.02, kWideAtRest = 0.65;

/// face: V x 3, upright. landmarks: its vertices, in iBUG order.
RestExpression MeasureRest(const geometry::Points& face, const std::array<int, 68>& landmarks);

/// A line each for a mouth that is open, and for one that is wide with raised corners, with the repair.
std::vector<std::string> WarningsOf(const RestExpression& rest);

}  // namespace daumier::rig
