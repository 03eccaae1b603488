#pragma once
#include "geometry/mesh.h"

#include <Eigen/Core>

#include <vector>

namespace daumier::geometry {

/// A surface to decimate.
struct DecimationInput {
  const TriangleMesh& mesh;
  const Eigen::MatrixXf&
      offsets;                   ///< 3V x T, cm: the surface's other poses are mesh.vertices + column t. May be empty.
  std::vector<int> labels = {};  ///< F: borders between labels are kept. Empty: there are none.
  std::vector<float> importance = {};  ///< F: factor of the error. Empty: 1.
  std::vector<int> kept = {};          ///< Vertices that stay.
};

struct DecimatedSurface {
  Triangles triangles;     ///< Of the vertices of the input.
  Triangles uv_triangles;  ///< Of its rows of UV; 0 x 3 without UV.
  std::vector<int> rows;   ///< The triangle of the input that became each, ascending.
  bool is_reached = true;  ///< Whether there are at most `num_triangles`.
};

/// At most `num_triangles` triangles, by collapses of vertices onto neighbours in the order of their error in all poses
/// (PoseQuadrics), as CollapseMesh permits them. Vertices that remain have the place, UV and offsets that they had. Vertices
/// at one place with the same offsets are one; a file splits vertices along seams. Triangles that have a place twice are removed.
/// No triangle turns by 90 degrees or more in a collapse, in any pose, nor over in UV. A closed surface stays closed, with its genus.
/// If no further vertex may collapse, more triangles are left. Equal input gives equal output.
/// @throws Error as CheckUv, CollapseMesh and PoseQuadrics, or if a size differs.
DecimatedSurface Decimate(const DecimationInput& input, int num_triangles);

}  // namespace daumier::geometry
