#pragma once
#include <Eigen/Core>

#include <vector>

namespace daumier::geometry {

/// V x 3, row a vertex, in centimetres.
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// F x 3, row a triangle, counter-clockwise seen from outside.
using Triangles = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Vector3 = Eigen::Vector3d;

struct TriangleMesh {
  Points vertices;
  Triangles triangles;
};

/// Polygons of any number of corners: polygon p has the corners corners[offsets[p]] .. corners[offsets[p + 1] - 1].
struct PolygonMesh {
  Points vertices;
  std::vector<int> offsets = {0};
  std::vector<int> corners;

  int num_polygons() const { return static_cast<int>(offsets.size()) - 1; }
};

}  // namespace daumier::geometry
