#pragma once
#include "raster/mesh_topology.h"

#include <array>
#include <cstdint>
#include <vector>

namespace daumier::raster {

enum class Facing {
  kFront,  ///< Triangles that are counter-clockwise for the viewer (y up) are visible.
  kBoth,
};

/// A vertex in the picture: pixels, depth Z / w, and 1 / w. x is NaN behind the viewer.
template <class T>
struct alignas(4 * sizeof(T)) ScreenVertex {
  T x, y, depth, inverse_w;
};

/// The surface at each pixel's centre, and what the gradient needs. Its memory is reused by the next call.
template <class T>
struct Raster {
  int height = 0, width = 0;
  std::vector<int> triangle;   ///< H x W: row of the triangle in front, -1 where there is none.
  std::vector<T> barycentric;  ///< H x W x 2: b0 and b1 of the point on the surface, b2 = 1 - b0 - b1; 0 where
                               ///< there is no triangle.
  std::vector<T> depth;        ///< H x W: Z / w of the point; infinite where there is no triangle.
  std::vector<ScreenVertex<T>> vertices;  ///< V
  std::vector<int8_t> facing;             ///< T: 1 front, -1 back, 0 without area in the picture or behind the viewer.

  int64_t num_pixels() const { return int64_t(height) * width; }
};

/// Z-buffered triangles. positions: V x 4, homogeneous pixel coordinates (X, Y, Z, w) of raster/camera.h. With
/// p_i = (X_i, Y_i) - f w_i for a pixel centre f, a0 = p1 x p2, a1 = p2 x p0, a2 = p0 x p1: b_i = a_i / (a0 + a1 + a2)
/// [Laine et al. 2020, section 3.2], so that barycentrics are those of the point on the surface in perspective too.
/// Signs of edge functions are exact in float: a closed fan of triangles covers each pixel once. A centre on an edge
/// belongs to the triangle for which the edge is top or left. At equal depth the lower row wins. Triangles with a vertex
/// of w < kNearestW are left out, as are those seen edge-on.
/// @throws Error if the picture has no pixels, a side above 32,768, or a number is not finite.
template <class T>
void Rasterise(const MeshTopology& topology, const T* positions, int height, int width, Facing facing,
               Raster<T>& raster);

inline constexpr double kNearestW = 1e-3;

/// Adds to position_gradient (V x 4) the gradient of sum(barycentric * barycentric_gradient); barycentric_gradient:
/// H x W x 2. The third column of position_gradient is unchanged: depth carries no gradient. With c the function whose
/// gradient by b is given, and grad_f c its slope over the picture: dL/d(X_j, Y_j) = -b_j / w(f) grad_f c, dL/dw_j =
/// -f . dL/d(X_j, Y_j).
template <class T>
void RasteriseBackward(const MeshTopology& topology, const Raster<T>& raster, const T* barycentric_gradient,
                       T* position_gradient);

}  // namespace daumier::raster
