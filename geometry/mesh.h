#pragma once
#include <Eigen/Core>

#include <vector>

namespace daumier::geometry {

/// V x 3, row a vertex, in centimetres.
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// F x 3, row a triangle, counter-clockwise seen from outside.
using Triangles = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Vector3 = Eigen::Vector3d;
/// T x 2, row a texture coordinate (u, v) as in OBJ: u to the right, v up, (0, 0) the lower left corner of the picture.
/// Values outside [0, 1] are allowed: they repeat the picture or name another tile (UDIM).
using TextureCoordinates = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

/// A mesh has UV at every corner or nowhere (`uv` without rows). UV belongs to corners, not to vertices: along a seam
/// the corners at one vertex use different rows. Triangulation, Submesh, Subdivide, OBJ and PLY keep UV; a function
/// that returns Points or Triangles alone drops it.
struct TriangleMesh {
  Points vertices;
  Triangles triangles;
  TextureCoordinates uv{};
  Triangles uv_triangles{};  ///< Row of `uv` at each corner, parallel to `triangles`; 0 x 3 without UV.

  bool has_uv() const { return uv.rows() > 0; }
};

/// Polygons of any number of corners: polygon p has the corners corners[offsets[p]] .. corners[offsets[p + 1] - 1].
struct PolygonMesh {
  Points vertices;
  std::vector<int> offsets = {0};
  std::vector<int> corners{};
  TextureCoordinates uv{};
  std::vector<int> uv_corners{};  ///< Row of `uv` at each corner, parallel to `corners`; empty without UV.

  int num_polygons() const { return static_cast<int>(offsets.size()) - 1; }
  bool has_uv() const { return uv.rows() > 0; }
};

}  // namespace daumier::geometry
