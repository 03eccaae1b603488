#pragma once
#include "geometry/mesh.h"
#include "rig/rigged_head.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace daumier::rig {

/// A part of the atlas: triangles that are neighbours in it. Between two charts there is a gutter.
enum class TextureChart { kSkin, kNeckCap, kLidRim, kMouth, kTeeth, kTongue, kRightEye, kLeftEye };

/// Which triangle each texel of a square texture shows. Texel (row, column) has its middle at
///   u = (column + 1/2) / size, v = 1 - (row + 1/2) / size: row 0 is the top of the picture.
struct TexelMap {
  int size = 0;
  std::vector<int> triangles;            ///< size^2, row by row: a triangle of the texture space; -1: none.
  std::vector<Eigen::Vector3f> weights;  ///< size^2: of the triangle's corners, sum 1; 0 where there is none.

  int index(int row, int column) const { return row * size + column; }
  int num_texels() const { return size * size; }
};

/// One UV atlas for all faces of a topology. Its triangles are those of RiggedHead::mesh, then those of the right eye,
/// then those of the left one; its vertices are numbered likewise (JoinedMesh).
/// Promises: every corner lies within [0, 1]; triangles that overlap belong to one chart, and so do texels of different
/// charts that are nearer to each other than `kGutter`.
struct TextureSpace {
  geometry::Triangles triangles;
  geometry::TextureCoordinates uv;
  geometry::Triangles uv_triangles;              ///< Row of `uv` at each corner.
  std::vector<TextureChart> charts;              ///< One a triangle.
  std::vector<faces::HeadMaterial> materials{};  ///< One a triangle; may be empty.

  /// Texels whose middles lie in a triangle, an edge belonging to the first of its triangles. @throws Error unless size
  /// is 16 .. 8192.
  TexelMap Rasterise(int size) const;
};

/// The least distance between charts, as a share of the atlas: eight texels of 1024.
inline constexpr double kGutter = 8.0 / 1024;

/// For each texel the nearest one that shows a triangle, itself if it does, -1 if none is within `reach` texels: what a
/// gutter copies, so that filtering and mipmaps find no foreign colour at the border of a chart.
std::vector<int> NearestShownTexels(const TexelMap& texels, int reach);

/// How many texels have their middle inside of two triangles or more, by more than 1e-6 of both's extent.
int NumOverlappingTexels(const TextureSpace& space, int size);

/// The head and its eyes as one mesh in the neutral pose: vertices and triangles as TextureSpace numbers them.
geometry::TriangleMesh JoinedMesh(const RiggedHead& head);

}  // namespace daumier::rig
