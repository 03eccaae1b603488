#include "geometry/normals.h"

#include "core/error.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <utility>

namespace daumier::geometry {
namespace {

/// Edge k of a triangle, opposite to corner k, from corner k + 1 to corner k + 2.
std::array<Vector3, 3> OppositeEdges(const TriangleMesh& mesh, int triangle) {
  std::array<Vector3, 3> edges;
  for (int k = 0; k < 3; ++k) {
    edges[k] = mesh.vertices.row(mesh.triangles(triangle, (k + 2) % 3)) -
               mesh.vertices.row(mesh.triangles(triangle, (k + 1) % 3));
  }
  return edges;
}

/// Rows of unit length; rows of zeros stay (Eigen's own rowwise form makes them NaN).
Points NormalizedRows(Points rows) {
  for (auto row : rows.rowwise()) row.normalize();
  return rows;
}

}  // namespace

Points AreaNormals(const TriangleMesh& mesh) {
  Points normals(mesh.triangles.rows(), 3);
  for (int f = 0; f < mesh.triangles.rows(); ++f) {
    const auto edges = OppositeEdges(mesh, f);
    normals.row(f) = edges[0].cross(edges[1]);
  }
  return normals;
}

Points TriangleNormals(const TriangleMesh& mesh) {
  return NormalizedRows(AreaNormals(mesh));
}

Eigen::VectorXd TriangleAreas(const TriangleMesh& mesh) {
  return 0.5 * AreaNormals(mesh).rowwise().norm();
}

Points VertexNormals(const TriangleMesh& mesh) {
  Points normals = Points::Zero(mesh.vertices.rows(), 3);
  for (int f = 0; f < mesh.triangles.rows(); ++f) {
    const auto edges = OppositeEdges(mesh, f);
    const Vector3 normal = edges[0].cross(edges[1]);
    for (int k = 0; k < 3; ++k) {
      const double scale = edges[(k + 1) % 3].squaredNorm() * edges[(k + 2) % 3].squaredNorm();
      if (scale > 0) normals.row(mesh.triangles(f, k)) += normal / scale;
    }
  }
  return NormalizedRows(std::move(normals));
}

Points CornerAreas(const TriangleMesh& mesh) {
  Points areas = Points::Zero(mesh.triangles.rows(), 3);
  for (int f = 0; f < mesh.triangles.rows(); ++f) {
    const auto edges = OppositeEdges(mesh, f);
    const double area = 0.5 * edges[0].cross(edges[1]).norm();
    if (!(area > 0)) continue;
    std::array<double, 3> squared, weight;  // weight[k] > 0 iff the angle at corner k is acute.
    for (int k = 0; k < 3; ++k) squared[k] = edges[k].squaredNorm();
    for (int k = 0; k < 3; ++k) weight[k] = squared[k] * (squared[(k + 1) % 3] + squared[(k + 2) % 3] - squared[k]);
    const int widest = static_cast<int>(std::min_element(weight.begin(), weight.end()) - weight.begin());
    const int next = (widest + 1) % 3, last = (widest + 2) % 3;
    if (weight[widest] > 0) {
      const double scale = 0.5 * area / (weight[0] + weight[1] + weight[2]);
      for (int k = 0; k < 3; ++k) areas(f, k) = scale * (weight[(k + 1) % 3] + weight[(k + 2) % 3]);
    } else {
      areas(f, next) = -0.25 * squared[last] * area / edges[widest].dot(edges[last]);
      areas(f, last) = -0.25 * squared[next] * area / edges[widest].dot(edges[next]);
      areas(f, widest) = area - areas(f, next) - areas(f, last);
    }
  }
  return areas;
}

Eigen::VectorXd VertexAreas(const TriangleMesh& mesh) {
  const Points corners = CornerAreas(mesh);
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(mesh.vertices.rows());
  for (int f = 0; f < mesh.triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) areas[mesh.triangles(f, k)] += corners(f, k);
  }
  return areas;
}

Eigen::VectorXd TrianglesToVertices(const TriangleMesh& mesh, const Eigen::VectorXd& values) {
  DAUMIER_CHECK(values.size() == mesh.triangles.rows(), "{} values for {} triangles", values.size(),
                mesh.triangles.rows());
  const Eigen::VectorXd areas = TriangleAreas(mesh);
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(mesh.vertices.rows()), weights = sums;
  for (int f = 0; f < mesh.triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      sums[mesh.triangles(f, k)] += areas[f] * values[f];
      weights[mesh.triangles(f, k)] += areas[f];
    }
  }
  return (weights.array() > 0).select(sums.array() / weights.array(), 0.0);
}

Eigen::VectorXd VerticesToTriangles(const Triangles& triangles, const Eigen::VectorXd& values) {
  Eigen::VectorXd means(triangles.rows());
  for (int f = 0; f < triangles.rows(); ++f) {
    means[f] = (values[triangles(f, 0)] + values[triangles(f, 1)] + values[triangles(f, 2)]) / 3;
  }
  return means;
}

}  // namespace daumier::geometry
