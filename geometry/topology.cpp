#include "geometry/topology.h"

#include "core/error.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <span>
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
Adjacency Collect(const std::vector<std::pair<int, int>>& pairs, int num_items) {
  std::vector<int> first(num_items + 1, 0);
  for (const auto& [item, value] : pairs) ++first[item + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<int> values(pairs.size()), filled(first.begin(), first.end() - 1);
  for (const auto& [item, value] : pairs) values[filled[item]++] = value;

  Adjacency adjacency;
  adjacency.offsets.assign(num_items + 1, 0);
  adjacency.values.reserve(values.size());
  for (int i = 0; i < num_items; ++i) {
    const auto begin = values.begin() + first[i], end = values.begin() + first[i + 1];
    std::sort(begin, end);
    adjacency.values.insert(adjacency.values.end(), begin, std::unique(begin, end));
    adjacency.offsets[i + 1] = static_cast<int>(adjacency.values.size());
  }
  return adjacency;
}

/// A triangle seen from one of its corners: the two others in their order.
struct OpenCorner {
  int next, last;
  bool operator<(const OpenCorner& other) const { return next < other.next; }
};

/// The corners of all triangles by their vertex, in the order of `next`, so that (vertex, next) are the directed edges.
struct CornersAtVertices {
  std::vector<int> offsets;
  std::vector<OpenCorner> corners;

  std::span<OpenCorner> at(int vertex) {
    return std::span(corners).subspan(offsets[vertex], offsets[vertex + 1] - offsets[vertex]);
  }
  bool HasEdge(int from, int to) {
    const std::span<OpenCorner> fan = at(from);
    return std::binary_search(fan.begin(), fan.end(), OpenCorner{to, -1});
  }
};

CornersAtVertices CollectCorners(const Triangles& triangles, int num_vertices) {
  CornersAtVertices collected;
  collected.offsets.assign(num_vertices + 1, 0);
  for (const int v : triangles.reshaped()) ++collected.offsets[v + 1];
  std::partial_sum(collected.offsets.begin(), collected.offsets.end(), collected.offsets.begin());
  collected.corners.resize(3 * triangles.rows());
  std::vector<int> filled(collected.offsets.begin(), collected.offsets.end() - 1);
  for (const auto& t : triangles.rowwise()) {
    for (int k = 0; k < 3; ++k) collected.corners[filled[t[k]]++] = {t[(k + 1) % 3], t[(k + 2) % 3]};
  }
  for (int v = 0; v < num_vertices; ++v) std::sort(collected.at(v).begin(), collected.at(v).end());
  return collected;
}

/// The fan of triangles at a vertex is one iff its outgoing edges, each leading on to the next, form one chain or one
/// ring.
bool IsOneFan(std::span<const OpenCorner> fan, std::vector<int>& ends) {
  ends.clear();
  for (const OpenCorner& corner : fan) ends.push_back(corner.last);
  std::sort(ends.begin(), ends.end());
  // An open fan is walked from its free end.
  const auto free_end = std::find_if(fan.begin(), fan.end(), [&](const OpenCorner& corner) {
    return !std::binary_search(ends.begin(), ends.end(), corner.next);
  });
  const auto start = free_end == fan.end() ? fan.begin() : free_end;
  auto corner = start;
  size_t length = 0;
  do {
    ++length;
    const int next = corner->last;
    corner = std::lower_bound(fan.begin(), fan.end(), OpenCorner{next, -1});
    if (corner == fan.end() || corner->next != next) break;
  } while (corner != start && length < fan.size());
  return length == fan.size();
}

/// The corners of triangles that form a manifold. @throws Error as CheckManifold.
CornersAtVertices ManifoldCorners(const Triangles& triangles, int num_vertices) {
  CheckCorners(triangles, num_vertices);
  for (int f = 0; f < triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k)
      DAUMIER_CHECK(triangles(f, k) != triangles(f, (k + 1) % 3), "triangle {} has vertex {} twice", f,
                    triangles(f, k));
  }
  CornersAtVertices collected = CollectCorners(triangles, num_vertices);
  std::vector<int> ends;
  for (int v = 0; v < num_vertices; ++v) {
    const std::span<const OpenCorner> fan = collected.at(v);
    if (fan.empty()) continue;
    const auto twice = std::adjacent_find(fan.begin(), fan.end(),
                                          [](const OpenCorner& a, const OpenCorner& b) { return a.next == b.next; });
    DAUMIER_CHECK(twice == fan.end(), "two triangles run from vertex {} to {}: non-manifold or wound wrongly", v,
                  twice->next);
    DAUMIER_CHECK(IsOneFan(fan, ends), "two separate fans of triangles meet at vertex {}", v);
  }
  return collected;
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
  return Collect(pairs, num_vertices);
}

Adjacency TrianglesAtVertices(const Triangles& triangles, int num_vertices) {
  CheckCorners(triangles, num_vertices);
  std::vector<std::pair<int, int>> pairs;
  pairs.reserve(3 * triangles.rows());
  for (int f = 0; f < triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) pairs.emplace_back(triangles(f, k), f);
  }
  return Collect(pairs, num_vertices);
}

void CheckManifold(const Triangles& triangles, int num_vertices) {
  ManifoldCorners(triangles, num_vertices);
}

std::vector<std::vector<int>> BoundaryLoops(const Triangles& triangles, int num_vertices) {
  CornersAtVertices corners = ManifoldCorners(triangles, num_vertices);
  // An edge without its opposite runs along a hole, with the surface on its left. Since the triangles at a vertex are
  // one fan, no more than one such edge leaves it.
  std::vector<int> next(num_vertices, -1);
  for (int from = 0; from < num_vertices; ++from) {
    for (const OpenCorner& corner : corners.at(from)) {
      if (!corners.HasEdge(corner.next, from)) next[from] = corner.next;
    }
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
