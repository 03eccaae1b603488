#include "geometry/curvature.h"

#include "core/error.h"
#include "geometry/normals.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <set>

namespace daumier::geometry {
namespace {

/// V: whether a vertex lies on an edge with one triangle.
std::vector<bool> OnBoundary(const Triangles& triangles, int num_vertices) {
  std::set<std::pair<int, int>> directed;
  for (const auto& t : triangles.rowwise()) {
    for (int k = 0; k < 3; ++k) directed.emplace(t[k], t[(k + 1) % 3]);
  }
  std::vector<bool> on_boundary(num_vertices);
  for (const auto& [from, to] : directed) {
    if (!directed.contains({to, from})) on_boundary[from] = on_boundary[to] = true;
  }
  return on_boundary;
}

}  // namespace

Eigen::VectorXd AngleDefects(const TriangleMesh& mesh) {
  const int num_vertices = static_cast<int>(mesh.vertices.rows());
  Eigen::VectorXd angles = Eigen::VectorXd::Zero(num_vertices);
  std::vector<bool> is_used(num_vertices);
  for (const auto& t : mesh.triangles.rowwise()) {
    for (int k = 0; k < 3; ++k) {
      const Vector3 a = mesh.vertices.row(t[(k + 1) % 3]) - mesh.vertices.row(t[k]);
      const Vector3 b = mesh.vertices.row(t[(k + 2) % 3]) - mesh.vertices.row(t[k]);
      angles[t[k]] += std::atan2(a.cross(b).norm(), a.dot(b));
      is_used[t[k]] = true;
    }
  }
  const std::vector<bool> on_boundary = OnBoundary(mesh.triangles, num_vertices);
  for (int v = 0; v < num_vertices; ++v) {
    angles[v] = is_used[v] ? (on_boundary[v] ? 1 : 2) * std::numbers::pi - angles[v] : 0.0;
  }
  return angles;
}

Eigen::VectorXd GaussianCurvature(const TriangleMesh& mesh) {
  Eigen::VectorXd curvature = AngleDefects(mesh);
  const Eigen::VectorXd areas = VertexAreas(mesh);
  const std::vector<bool> on_boundary = OnBoundary(mesh.triangles, static_cast<int>(mesh.vertices.rows()));
  for (int v = 0; v < curvature.size(); ++v)
    curvature[v] = on_boundary[v] || !(areas[v] > 0) ? 0.0 : curvature[v] / areas[v];
  return curvature;
}

Eigen::VectorXd SmoothOverRings(const Eigen::VectorXd& values, const Eigen::VectorXd& vertex_areas,
                                const Adjacency& neighbours, int rounds) {
  DAUMIER_CHECK(values.size() == neighbours.size() && vertex_areas.size() == values.size(),
                "{} values and {} areas for {} vertices", values.size(), vertex_areas.size(), neighbours.size());
  Eigen::VectorXd smooth = values;
  for (int round = 0; round < rounds; ++round) {
    const Eigen::VectorXd before = smooth;
    for (int v = 0; v < before.size(); ++v) {
      double sum = vertex_areas[v] * before[v], weight = vertex_areas[v];
      for (const int other : neighbours[v]) {
        sum += vertex_areas[other] * before[other];
        weight += vertex_areas[other];
      }
      if (weight > 0) smooth[v] = sum / weight;
    }
  }
  return smooth;
}

}  // namespace daumier::geometry
