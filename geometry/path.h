#pragma once
#include "geometry/topology.h"

#include <vector>

namespace daumier::geometry {

/// The shortest way along mesh edges, by length in cm [Dijkstra 1959], both ends included; of equally long ways the one
/// whose vertices have the lower indices seen from `to`. @throws Error if the two are not connected or out of range.
std::vector<int> ShortestPath(const Points& points, const Adjacency& neighbours, int from, int to);

enum class PathEnds { kOpen, kClosed };

/// Joins consecutive waypoints by shortest paths. No vertex comes twice in a row; a closed path leads back to the first
/// waypoint and does not repeat it. @throws Error with fewer than two waypoints, or as ShortestPath.
std::vector<int> TracePath(const Points& points, const Adjacency& neighbours, const std::vector<int>& waypoints,
                           PathEnds ends);

}  // namespace daumier::geometry
