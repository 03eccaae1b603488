#pragma once
#include "geometry/mesh.h"
#include "geometry/topology.h"

#include <vector>

namespace daumier::rig {

/// A head mesh of any topology as one vertex a place: files split vertices along seams of UV.
struct HeadSurface {
  geometry::TriangleMesh mesh;     ///< P places, without UV; without triangles of fewer than three places.
  geometry::Points normals;        ///< P x 3, of unit length; 0 at a place without a triangle that has area.
  geometry::Adjacency neighbours;  ///< Of places.
  std::vector<int> components;     ///< P: of connected places the same, 0, 1, ...
  std::vector<int> places;         ///< The place of each vertex of the head mesh; -1 where no triangle uses it.

  int num_places() const { return int(mesh.vertices.rows()); }
  int num_components() const;
};

/// @throws Error if a corner is no vertex, or if no triangle is left.
HeadSurface MakeHeadSurface(const geometry::TriangleMesh& head);

/// 3V x T from 3P x T: each vertex moves as its place, those without a place do not move.
Eigen::MatrixXf OffsetsOfVertices(const HeadSurface& surface, const Eigen::MatrixXf& of_places);

}  // namespace daumier::rig
