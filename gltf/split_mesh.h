#pragma once
#include "faces/head_material.h"
#include "geometry/mesh.h"

#include <cstdint>
#include <vector>

namespace daumier::gltf {

/// A mesh as graphics cards take it: UV belongs to vertices, so a vertex of the source occurs once for each UV that its
/// corners have.
struct SplitMesh {
  std::vector<int> source_vertices;              ///< N: vertex of the source of each vertex.
  geometry::TextureCoordinates uv;               ///< N x 2, as in the source; no rows where that has no UV.
  std::vector<faces::HeadMaterial> materials{};  ///< N; empty unless it is split by material.
  std::vector<uint32_t> indices;                 ///< 3F, in the order of the source's triangles.

  int num_vertices() const { return static_cast<int>(source_vertices.size()); }
};

/// Vertices in ascending order of the source's, without those that no triangle uses. Rows of UV with the same values are
/// one. If `materials` (F) are not empty, corners of different materials at one vertex are split as well.
/// @throws Error as CheckUv, if a corner names no vertex, or if materials are not one a triangle.
SplitMesh SplitAtSeams(const geometry::TriangleMesh& mesh, const std::vector<faces::HeadMaterial>& materials);

/// The same mesh with triangles and vertices in an order that compresses well.
SplitMesh OrderForCompression(const SplitMesh& mesh);

}  // namespace daumier::gltf
