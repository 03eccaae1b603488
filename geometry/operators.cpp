#include "geometry/operators.h"

#include "core/error.h"
#include "geometry/normals.h"
#include "geometry/topology.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <vector>

namespace daumier::geometry {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

SparseMatrix ToSparse(int rows, int columns, const Triplets& triplets) {
  SparseMatrix matrix(rows, columns);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  return matrix;
}

void AddEdge(Triplets& triplets, int i, int j, double weight) {
  triplets.emplace_back(i, i, weight);
  triplets.emplace_back(j, j, weight);
  triplets.emplace_back(i, j, -weight);
  triplets.emplace_back(j, i, -weight);
}

void CheckAreas(const Eigen::VectorXd& areas) {
  for (int f = 0; f < areas.size(); ++f) DAUMIER_CHECK(areas[f] > 0, "triangle {} has no area", f);
}

}  // namespace

Points CornerCotangents(const TriangleMesh& mesh, double min_cotangent) {
  const Eigen::VectorXd areas = TriangleAreas(mesh);
  CheckAreas(areas);
  Points cotangents(mesh.triangles.rows(), 3);
  for (int f = 0; f < mesh.triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const auto corner = mesh.vertices.row(mesh.triangles(f, k));
      const Vector3 a = mesh.vertices.row(mesh.triangles(f, (k + 1) % 3)) - corner;
      const Vector3 b = mesh.vertices.row(mesh.triangles(f, (k + 2) % 3)) - corner;
      cotangents(f, k) = std::max(a.dot(b) / (2 * areas[f]), min_cotangent);
    }
  }
  return cotangents;
}

SparseMatrix CotangentLaplacian(const TriangleMesh& mesh, double min_cotangent,
                                const Eigen::VectorXd& triangle_scales) {
  const int num_vertices = static_cast<int>(mesh.vertices.rows()),
            num_triangles = static_cast<int>(mesh.triangles.rows());
  DAUMIER_CHECK(triangle_scales.size() == 0 || triangle_scales.size() == num_triangles, "{} scales for {} triangles",
                triangle_scales.size(), num_triangles);
  const Points cotangents = CornerCotangents(mesh, min_cotangent);
  Triplets triplets;
  triplets.reserve(12 * num_triangles);
  for (int f = 0; f < num_triangles; ++f) {
    const double scale = triangle_scales.size() ? triangle_scales[f] : 1.0;
    for (int k = 0; k < 3; ++k) {
      AddEdge(triplets, mesh.triangles(f, (k + 1) % 3), mesh.triangles(f, (k + 2) % 3), 0.5 * scale * cotangents(f, k));
    }
  }
  return ToSparse(num_vertices, num_vertices, triplets);
}

SparseMatrix UniformLaplacian(const Triangles& triangles, int num_vertices) {
  const Adjacency neighbours = VertexNeighbours(triangles, num_vertices);
  Triplets triplets;
  for (int v = 0; v < num_vertices; ++v) {
    for (const int other : neighbours[v]) {
      if (v < other) AddEdge(triplets, v, other, 1.0);
    }
  }
  return ToSparse(num_vertices, num_vertices, triplets);
}

SparseMatrix Gradient(const TriangleMesh& mesh) {
  const Points normals = AreaNormals(mesh);
  CheckAreas(normals.rowwise().norm());
  Triplets triplets;
  triplets.reserve(9 * mesh.triangles.rows());
  for (int f = 0; f < mesh.triangles.rows(); ++f) {
    const Vector3 normal = normals.row(f);
    for (int k = 0; k < 3; ++k) {
      const Vector3 edge =
          mesh.vertices.row(mesh.triangles(f, (k + 2) % 3)) - mesh.vertices.row(mesh.triangles(f, (k + 1) % 3));
      const Vector3 hat_gradient = normal.cross(edge) / normal.squaredNorm();  // Of the function that is 1 at corner k.
      for (int axis = 0; axis < 3; ++axis)
        triplets.emplace_back(3 * f + axis, mesh.triangles(f, k), hat_gradient[axis]);
    }
  }
  return ToSparse(3 * static_cast<int>(mesh.triangles.rows()), static_cast<int>(mesh.vertices.rows()), triplets);
}

SparseMatrix Divergence(const TriangleMesh& mesh) {
  const Eigen::VectorXd areas = TriangleAreas(mesh);
  Eigen::VectorXd row_areas(3 * areas.size());
  for (int f = 0; f < areas.size(); ++f) row_areas.segment<3>(3 * f).setConstant(areas[f]);
  return SparseMatrix(Gradient(mesh).transpose() * row_areas.asDiagonal());
}

}  // namespace daumier::geometry
