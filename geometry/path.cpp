#include "geometry/path.h"

#include "core/error.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <tuple>
#include <utility>

namespace daumier::geometry {

std::vector<int> ShortestPath(const Points& points, const Adjacency& neighbours, int from, int to) {
  const int num_vertices = neighbours.size();
  DAUMIER_CHECK(std::min(from, to) >= 0 && std::max(from, to) < num_vertices,
                "no path from vertex {} to {}: there are {}", from, to, num_vertices);
  std::vector<double> distance(num_vertices, std::numeric_limits<double>::infinity());
  std::vector<int> previous(num_vertices, -1);
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  distance[from] = 0;
  queue.emplace(0.0, from);
  while (!queue.empty()) {
    const auto [so_far, v] = queue.top();
    queue.pop();
    if (so_far > distance[v]) continue;
    if (v == to) break;
    for (const int next : neighbours[v]) {
      const double length = so_far + (points.row(next) - points.row(v)).norm();
      const bool shorter = length < distance[next];
      if (shorter || (length == distance[next] && v < previous[next])) previous[next] = v;
      if (!shorter) continue;
      distance[next] = length;
      queue.emplace(length, next);
    }
  }
  DAUMIER_CHECK(from == to || previous[to] != -1, "vertices {} and {} are not connected by edges", from, to);
  std::vector<int> path = {to};
  while (path.back() != from) path.push_back(previous[path.back()]);
  std::reverse(path.begin(), path.end());
  return path;
}

NearestSeeds FindNearestSeeds(const Points& points, const Adjacency& neighbours, const std::vector<int>& seeds,
                              double reach, const std::vector<bool>& is_open) {
  const size_t num_vertices = size_t(neighbours.size());
  DAUMIER_CHECK(is_open.empty() || is_open.size() == num_vertices, "{} vertices are open or not, expected {}",
                is_open.size(), num_vertices);
  NearestSeeds nearest{std::vector<int>(num_vertices, -1),
                       std::vector<double>(num_vertices, std::numeric_limits<double>::infinity())};
  using Entry = std::tuple<double, int, int>;  // Distance, place of the seed, vertex.
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto reach_vertex = [&](int v, double distance, int seed) {
    const auto known = std::pair(nearest.distances[size_t(v)], nearest.seeds[size_t(v)]);
    if (distance > reach || std::pair(distance, seed) >= known) return;
    nearest.distances[size_t(v)] = distance;
    nearest.seeds[size_t(v)] = seed;
    queue.emplace(distance, seed, v);
  };
  for (size_t i = 0; i < seeds.size(); ++i) {
    DAUMIER_CHECK(seeds[i] >= 0 && size_t(seeds[i]) < num_vertices, "seed {} is no vertex: there are {}", seeds[i],
                  num_vertices);
    reach_vertex(seeds[i], 0, int(i));
  }
  while (!queue.empty()) {
    const auto [distance, seed, v] = queue.top();
    queue.pop();
    if (distance > nearest.distances[size_t(v)] || seed != nearest.seeds[size_t(v)]) continue;
    for (const int next : neighbours[v])
      if (is_open.empty() || is_open[size_t(next)])
        reach_vertex(next, distance + (points.row(next) - points.row(v)).norm(), seed);
  }
  return nearest;
}

std::vector<int> TracePath(const Points& points, const Adjacency& neighbours, const std::vector<int>& waypoints,
                           PathEnds ends) {
  DAUMIER_CHECK(waypoints.size() >= 2, "a path needs two waypoints, got {}", waypoints.size());
  std::vector<int> path = {waypoints.front()};
  const size_t num_legs = waypoints.size() - (ends == PathEnds::kClosed ? 0 : 1);
  for (size_t i = 0; i < num_legs; ++i) {
    const std::vector<int> leg = ShortestPath(points, neighbours, waypoints[i], waypoints[(i + 1) % waypoints.size()]);
    path.insert(path.end(), leg.begin() + 1, leg.end());
  }
  if (ends == PathEnds::kClosed) path.pop_back();
  return path;
}

}  // namespace daumier::geometry
