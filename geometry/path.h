#pragma once
#include "geometry/topology.h"

#include <vector>

namespace daumier::geometry {

/// The shortest way along mesh edges, by length in cm [Dijkstra 1959], both ends included; of equally long ways the one
/// whose vertices have the lower indices seen from `to`. @throws Error if the two are not connected or out of range.
std::vector<int> ShortestPath(const Points& points, const Adjacency& neighbours, int from, int to);

/// For each vertex the nearest of some seeds along mesh edges.
struct NearestSeeds {
  std::vector<int> seeds;         ///< V: the place in the list of seeds; -1 where none is within reach.
  std::vector<double> distances;  ///< V, cm; infinite without a seed.
};
/// seeds: vertices; one that comes twice counts the first time. Of equally near seeds the one of the lower place. Ways
/// lead through vertices within `reach` cm of a seed alone, and `is_open` ones if it is not empty. @throws Error if a seed
/// is out of range, or `is_open` has another size.
NearestSeeds FindNearestSeeds(const Points& points, const Adjacency& neighbours, const std::vector<int>& seeds,
                              double reach, const std::vector<bool>& is_open = {});

enum class PathEnds { kOpen, kClosed };

/// Joins consecutive waypoints by shortest paths. No vertex comes twice in a row; a closed path leads back to the first
/// waypoint and does not repeat it. @throws Error with fewer than two waypoints, or as ShortestPath.
std::vector<int> TracePath(const Points& points, const Adjacency& neighbours, const std::vector<int>& waypoints,
                           PathEnds ends);

}  // namespace daumier::geometry
