#include "geometry/topology.h"

#include "core/error.h"

#include <algorithm>
#include <set>
#include <unordered_map>
#include <utility>

namespace daumier::geometry {
namespace {

void CheckCorners(const Triangles& triangles, int num_vertices) {
  if (triangles.rows() == 0) return;
  const int low = triangles.minCoeff(), high = triangles.maxCoeff();
  DAUMIER_CHECK(low >= 0 && high < num_vertices, "triangles use vertices {} to {}, there are {}", low, high,
                num_vertices);
}

/// Lists of distinct ascending values from (item, value) pairs.
Adjacency Collect(std::vector<std::pair<int, int>> pairs, int num_items) {
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  Adjacency adjacency;
  adjacency.offsets.assign(num_items + 1, 0);
  adjacency.values.reserve(pairs.size());
  for (const auto& [item, value] : pairs) {
    ++adjacency.offsets[item + 1];
    adjacency.values.push_back(value);
  }
  for (int i = 0; i < num_items; ++i) adjacency.offsets[i + 1] += adjacency.offsets[i];
  return adjacency;
}

/// The fan of triangles at a vertex is one iff its outgoing edges, each leading on to the next, form one chain or one
/// ring.
void CheckSingleFans(const Triangles& triangles, int num_vertices) {
  const Adjacency fans = TrianglesAtVertices(triangles, num_vertices);
  for (int v = 0; v < num_vertices; ++v) {
    std::unordered_map<int, int> next;  // From the corner that follows v to the one that precedes it.
    std::set<int> ends;
    for (const int f : fans[v]) {
      const int k = triangles(f, 0) == v ? 0 : triangles(f, 1) == v ? 1 : 2;
      next[triangles(f, (k + 1) % 3)] = triangles(f, (k + 2) % 3);
      ends.insert(triangles(f, (k + 2) % 3));
    }
    if (next.empty()) continue;
    int start = next.begin()->first;
    for (const auto& [from, to] : next) {
      if (!ends.contains(from)) start = from;  // An open fan is walked from its free end.
    }
    size_t length = 0;
    int corner = start;
    do {
      ++length;
      corner = next[corner];
    } while (corner != start && next.contains(corner));
    DAUMIER_CHECK(length == next.size(), "two separate fans of triangles meet at vertex {}", v);
  }
}

/// The edges (from, to) of all triangles in their direction. @throws Error as CheckManifold.
std::set<std::pair<int, int>> DirectedEdges(const Triangles& triangles, int num_vertices) {
  CheckCorners(triangles, num_vertices);
  std::set<std::pair<int, int>> directed;
  for (int f = 0; f < triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int from = triangles(f, k), to = triangles(f, (k + 1) % 3);
      DAUMIER_CHECK(from != to, "triangle {} has vertex {} twice", f, from);
      DAUMIER_CHECK(directed.emplace(from, to).second,
                    "two triangles run from vertex {} to {}: non-manifold or wound wrongly", from, to);
    }
  }
  CheckSingleFans(triangles, num_vertices);
  return directed;
}

}  // namespace

Adjacency VertexNeighbours(const Triangles& triangles, int num_vertices) {
  CheckCorners(triangles, num_vertices);
  std::vector<std::pair<int, int>> pairs;
  pairs.reserve(6 * triangles.rows());
  for (const auto& t : triangles.rowwise()) {
    for (int k = 0; k < 3; ++k) {
      pairs.emplace_back(t[k], t[(k + 1) % 3]);
      pairs.emplace_back(t[(k + 1) % 3], t[k]);
    }
  }
  return Collect(std::move(pairs), num_vertices);
}

Adjacency TrianglesAtVertices(const Triangles& triangles, int num_vertices) {
  CheckCorners(triangles, num_vertices);
  std::vector<std::pair<int, int>> pairs;
  pairs.reserve(3 * triangles.rows());
  for (int f = 0; f < triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) pairs.emplace_back(triangles(f, k), f);
  }
  return Collect(std::move(pairs), num_vertices);
}

void CheckManifold(const Triangles& triangles, int num_vertices) {
  DirectedEdges(triangles, num_vertices);
}

std::vector<std::vector<int>> BoundaryLoops(const Triangles& triangles, int num_vertices) {
  const auto edges = DirectedEdges(triangles, num_vertices);
  // An edge without its opposite runs along a hole, with the surface on its left. Since the triangles at a vertex are
  // one fan, no more than one such edge leaves it.
  std::vector<int> next(num_vertices, -1);
  for (const auto& [from, to] : edges) {
    if (!edges.contains({to, from})) next[from] = to;
  }
  std::vector<std::vector<int>> loops;
  for (int start = 0; start < num_vertices; ++start) {
    std::vector<int> loop;
    for (int v = start; next[v] != -1; v = std::exchange(next[v], -1)) loop.push_back(v);
    if (!loop.empty()) loops.push_back(std::move(loop));
  }
  std::sort(loops.begin(), loops.end(), [](const auto& a, const auto& b) {
    return a.size() != b.size() ? a.size() > b.size() : a.front() < b.front();
  });
  return loops;
}

std::vector<int> RingsFrom(const Adjacency& neighbours, const std::vector<int>& seeds) {
  std::vector<int> rings(neighbours.size(), -1), queue;
  for (const int seed : seeds) {
    DAUMIER_CHECK(seed >= 0 && seed < neighbours.size(), "vertex {} is out of range, there are {}", seed,
                  neighbours.size());
    if (rings[seed] == 0) continue;
    rings[seed] = 0;
    queue.push_back(seed);
  }
  for (size_t i = 0; i < queue.size(); ++i) {
    for (const int next : neighbours[queue[i]]) {
      if (rings[next] != -1) continue;
      rings[next] = rings[queue[i]] + 1;
      queue.push_back(next);
    }
  }
  return rings;
}

std::vector<int> VerticesWithin(const Adjacency& neighbours, const std::vector<int>& seeds, int rings) {
  const std::vector<int> distance = RingsFrom(neighbours, seeds);
  std::vector<int> vertices;
  for (int v = 0; v < neighbours.size(); ++v) {
    if (distance[v] >= 0 && distance[v] <= rings) vertices.push_back(v);
  }
  return vertices;
}

std::vector<int> ConnectedComponents(const Adjacency& neighbours) {
  std::vector<int> labels(neighbours.size(), -1), stack;
  int num_components = 0;
  for (int v = 0; v < neighbours.size(); ++v) {
    if (labels[v] != -1) continue;
    labels[v] = num_components;
    stack.push_back(v);
    while (!stack.empty()) {
      const int top = stack.back();
      stack.pop_back();
      for (const int next : neighbours[top]) {
        if (labels[next] != -1) continue;
        labels[next] = num_components;
        stack.push_back(next);
      }
    }
    ++num_components;
  }
  return labels;
}

int EulerCharacteristic(const Triangles& triangles) {
  std::set<int> vertices;
  std::set<std::pair<int, int>> edges;
  for (const auto& t : triangles.rowwise()) {
    for (int k = 0; k < 3; ++k) {
      vertices.insert(t[k]);
      edges.insert(std::minmax({t[k], t[(k + 1) % 3]}));
    }
  }
  return static_cast<int>(vertices.size()) - static_cast<int>(edges.size()) + static_cast<int>(triangles.rows());
}

}  // namespace daumier::geometry
