#pragma once
#include "raster/mesh_topology.h"

#include <cstdint>
#include <vector>

namespace daumier::raster {

enum class Facing {
  kFront,  ///< Triangles that are counter-clockwise for the viewer (y up) are visible.
  kBoth,
};

/// A vertex in the picture: pixels, depth Z / w, and 1 / w. x is NaN where w < kNearestW, at the viewer or behind.
template <class T>
struct alignas(4 * sizeof(T)) ScreenVertex {
  T x, y, depth, inverse_w;
};
inline constexpr double kNearestW = 1e-3;

/// A triangle that may cover pixel centres, and the pixels that hold it, bounds included.
struct DrawnTriangle {
  int row, left, top, right, bottom;
};

/// Greatest height and width of a picture.
inline constexpr int kMaxPictureSide = 32768;

/// The surface at each pixel's centre, and what gradients need. The next call reuses its memory.
template <class T>
struct Raster {
  int height = 0, width = 0;
  std::vector<int> triangle;   ///< H x W: row of the triangle in front, -1 where there is none.
  std::vector<T> barycentric;  ///< H x W x 2: b0, b1 of the point on the surface; b2 = 1 - b0 - b1. 0 without triangle.
  std::vector<T> depth;        ///< H x W: Z / w of the point; infinite where there is no triangle.
  std::vector<ScreenVertex<T>> vertices;  ///< V
  std::vector<int8_t> facing;  ///< A triangle: 1 front, -1 back, 0 seen edge-on or with a vertex of w < kNearestW.

  std::vector<DrawnTriangle> drawn;  ///< In the order of rows.

  int64_t num_pixels() const { return int64_t(height) * width; }
};

/// The first half of Rasterise (raster/rasterise.h): everything but the barycentrics, whose memory is left as it is.
/// @throws Error as Rasterise.
template <class T>
void FindVisibleTriangles(const MeshTopology& topology, const T* positions, int height, int width, Facing facing,
                          Raster<T>& raster);

}  // namespace daumier::raster
