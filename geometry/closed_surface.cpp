#include "geometry/closed_surface.h"

#include "core/error.h"
#include "geometry/submesh.h"
#include "geometry/topology.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <utility>

namespace daumier::geometry {
namespace {

/// The triangles along an edge from its lower to its higher vertex, and against it: 3 f + k for the side k of triangle f.
struct SidesAtEdge {
  std::vector<int> along, against;
};

std::map<std::pair<int, int>, SidesAtEdge> SidesByEdge(const Triangles& triangles) {
  std::map<std::pair<int, int>, SidesAtEdge> edges;
  for (int f = 0; f < triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int from = triangles(f, k), to = triangles(f, (k + 1) % 3);
      SidesAtEdge& sides = edges[std::minmax(from, to)];
      (from < to ? sides.along : sides.against).push_back(3 * f + k);
    }
  return edges;
}

class UnionFind {
 public:
  explicit UnionFind(int count) : parents_(size_t(count)) { std::iota(parents_.begin(), parents_.end(), 0); }
  int Root(int i) {
    while (parents_[size_t(i)] != i) i = parents_[size_t(i)] = parents_[size_t(parents_[size_t(i)])];
    return i;
  }
  void Join(int a, int b) { parents_[size_t(std::max(Root(a), Root(b)))] = std::min(Root(a), Root(b)); }

 private:
  std::vector<int> parents_;
};

}  // namespace

bool IsClosed(const Triangles& triangles) {
  return std::ranges::all_of(SidesByEdge(triangles), [](const auto& edge) {
    return edge.second.along.size() == 1 && edge.second.against.size() == 1;
  });
}

double EnclosedVolume(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles.rowwise()) {
    const Vector3 a = mesh.vertices.row(t[0]), b = mesh.vertices.row(t[1]), c = mesh.vertices.row(t[2]);
    sum += a.dot(b.cross(c));
  }
  return sum / 6;
}

ManifoldSurface CutToManifold(const TriangleMesh& mesh) {
  ManifoldSurface result;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    const auto t = mesh.triangles.row(f);
    DAUMIER_CHECK(t.minCoeff() >= 0 && t.maxCoeff() < mesh.vertices.rows(),
                  "triangle {} names a vertex that is not there", f);
    DAUMIER_CHECK(t[0] != t[1] && t[1] != t[2] && t[2] != t[0], "triangle {} has a vertex twice", f);
  }
  const auto next = [](int corner) { return corner / 3 * 3 + (corner + 1) % 3; };
  UnionFind corners(int(mesh.triangles.size()));
  for (const auto& [edge, sides] : SidesByEdge(mesh.triangles)) {
    if (sides.along.size() == 1 && sides.against.size() == 1) {
      corners.Join(sides.along[0], next(sides.against[0]));
      corners.Join(next(sides.along[0]), sides.against[0]);
    } else if (sides.along.size() + sides.against.size() > 1) {
      ++result.num_bad_edges;
    }
  }
  std::vector<int> numbers(size_t(mesh.triangles.size()), -1), sources;
  result.mesh.triangles.resize(mesh.triangles.rows(), 3);
  for (int corner = 0; corner < mesh.triangles.size(); ++corner) {
    int& number = numbers[size_t(corners.Root(corner))];
    if (number < 0) {
      number = int(sources.size());
      sources.push_back(mesh.triangles(corner / 3, corner % 3));
    }
    result.mesh.triangles(corner / 3, corner % 3) = number;
  }
  result.mesh.vertices = mesh.vertices(sources, Eigen::all);
  return result;
}

void FillHole(const std::vector<int>& loop, TriangleMesh& mesh) {
  const auto middle = int(mesh.vertices.rows());
  const Eigen::RowVector3d place = mesh.vertices(loop, Eigen::all).colwise().mean();
  mesh.vertices.conservativeResize(middle + 1, Eigen::NoChange);
  mesh.vertices.row(middle) = place;
  const Eigen::Index first = mesh.triangles.rows();
  mesh.triangles.conservativeResize(first + std::ssize(loop), Eigen::NoChange);
  for (size_t i = 0; i < loop.size(); ++i)
    mesh.triangles.row(first + Eigen::Index(i)) << loop[(i + 1) % loop.size()], loop[i], middle;
}

std::vector<TriangleMesh> ConnectedParts(const TriangleMesh& mesh) {
  const int num_vertices = int(mesh.vertices.rows());
  const std::vector<int> labels = ConnectedComponents(VertexNeighbours(mesh.triangles, num_vertices));
  std::map<int, std::vector<int>> vertices;
  for (const int v : mesh.triangles.reshaped()) vertices[labels[size_t(v)]].push_back(v);
  TriangleMesh plain{mesh.vertices, mesh.triangles, {}, {}};
  plain.uv_triangles.resize(0, 3);
  std::vector<TriangleMesh> parts;
  for (const auto& [label, of_part] : vertices) parts.push_back(Submesh(plain, MapKept(of_part, num_vertices)));
  return parts;
}

TriangleMesh Joined(const std::vector<TriangleMesh>& parts) {
  Eigen::Index num_vertices = 0, num_triangles = 0;
  for (const TriangleMesh& part : parts) num_vertices += part.vertices.rows(), num_triangles += part.triangles.rows();
  TriangleMesh joined{Points(num_vertices, 3), Triangles(num_triangles, 3), {}, {}};
  joined.uv_triangles.resize(0, 3);
  num_vertices = num_triangles = 0;
  for (const TriangleMesh& part : parts) {
    joined.vertices.middleRows(num_vertices, part.vertices.rows()) = part.vertices;
    joined.triangles.middleRows(num_triangles, part.triangles.rows()) = part.triangles.array() + int(num_vertices);
    num_vertices += part.vertices.rows();
    num_triangles += part.triangles.rows();
  }
  return joined;
}

}  // namespace daumier::geometry
