#pragma once
#include "fitting/texture_projection.h"
#include "geometry/operators.h"

#include <Eigen/Core>

#include <array>
#include <span>
#include <vector>

namespace daumier::fitting {

/// Values at vertices, with how much each is known.
struct VertexValues {
  Eigen::MatrixXf values;   ///< N x K; 0 where the weight is.
  Eigen::VectorXf weights;  ///< N: sum of the texels' weights there.
};

/// Means at the vertices of what the texels of their triangles have: sum w b x / sum w b over texels, w their weight, b
/// the share of the corner. `triangle`: of each texel the row of `triangles`, -1: none; `weights`: of its corners.
/// @throws Error if the sizes disagree.
VertexValues MeansAtVertices(const geometry::Triangles& triangles, int num_vertices, std::span<const int> triangle,
                             std::span<const Eigen::Vector3f> weights, const TexelColours& colours);

struct SurfaceFillOptions {
  double stiffness = 1;
  double rest_weight = 1e-4;
};

/// The smoothest values on a surface that agree with those that are known: minimises
///   sum_v w_v |x_v - value_v|^2 + stiffness sum_edges |x_i - x_j|^2 + rest_weight sum_v |x_v - rest_v|^2,
/// on vertices, so that there is no seam where the atlas has one: a vertex where nothing is known gets the mean of its
/// neighbours, and far from all that is known it drifts to `rest` (N x K). Const and thread-safe: the order in which
/// unknowns are eliminated is found once.
class SurfaceFill {
 public:
  /// @throws Error as geometry::UniformLaplacian.
  SurfaceFill(const geometry::Triangles& triangles, int num_vertices);
  /// N x K. @throws Error if a size disagrees or rest_weight is not positive.
  Eigen::MatrixXf Solve(const VertexValues& known, const Eigen::MatrixXf& rest,
                        const SurfaceFillOptions& options = {}) const;

 private:
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order_;  ///< Ordered vertex of each vertex.
  geometry::SparseMatrix laplacian_;                                     ///< In that order.
};

inline Eigen::MatrixXf FillSurface(const geometry::Triangles& triangles, const VertexValues& known,
                                   const Eigen::MatrixXf& rest, const SurfaceFillOptions& options = {}) {
  return SurfaceFill(triangles, int(known.values.rows())).Solve(known, rest, options);
}

/// For each corner of a triangle of a texture space where its mirror image lies in the atlas.
struct MirroredCorners {
  std::vector<std::array<Eigen::Vector2f, 3>> uv;  ///< A triangle; NaN where it has no mirror image.
};

/// mirror: of each vertex of the space the one on the other side; -1: none. Of a vertex on a seam of the atlas, which has
/// several UV, those of one triangle that are nearest to each other. @throws Error if a size disagrees.
MirroredCorners FindMirroredCorners(const rig::TextureSpace& space, const std::vector<int>& mirror);

/// Colours and weights of the mirror images of texels: means of the four nearest texels by their weights and distances;
/// weight 0 where there is none.
TexelColours MirrorTexels(const rig::TexelMap& texels, const MirroredCorners& mirrored, const TexelColours& colours);

}  // namespace daumier::fitting
