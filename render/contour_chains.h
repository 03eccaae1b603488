#pragma once
#include "render/contours.h"

#include <vector>

namespace daumier::render {

/// Pieces of contours joined end to end.
struct ContourChain {
  geometry::Points points;                     ///< P x 3, in cm; a closed chain repeats its first point.
  Eigen::VectorXd strength;                    ///< P, ContourEnd::strength.
  std::vector<std::array<int, 2>> edges = {};  ///< P, ContourEnd::edge.
  bool closed = false;
};

/// Segments that meet on a mesh edge become one chain; each belongs to one chain, in the direction in which its first
/// segment (by index) runs. An edge where more than two segments meet, as on a surface that is not a manifold, joins
/// none of them. Chains come in the order of their first segment.
std::vector<ContourChain> ChainContours(const std::vector<ContourSegment>& segments);

}  // namespace daumier::render
