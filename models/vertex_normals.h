#pragma once
#include <torch/types.h>

namespace daumier::models {

/// Unit normals (B, V, 3) of vertices (B, V, 3) on a mesh: the sum of the unit normals of the triangles around a vertex,
/// of length 1 [Deng et al. 2019]; (0, 0, 0) where there is none. triangles: (T, 3) int32, counter-clockwise seen from
/// outside. Differentiable by the vertices, once, on the CPU, float32 or float64; the batch runs in parallel and its sums
/// have a fixed order. A triangle of area 0 has no normal and no gradient.
/// @throws daumier::Error if a shape or a type differs.
torch::Tensor VertexNormals(const torch::Tensor& vertices, const torch::Tensor& triangles);

}  // namespace daumier::models
