#pragma once
#include "raster/visibility.h"

#include <array>

namespace daumier::raster {

/// The visible triangle about a pixel's centre f: e_0 = s1 x s2, ... with s_i the corners in pixels minus f;
/// u_i = e_i / w_i, b_i = u_i / sum u. What kernels on pixels share.
template <class T>
struct SurfacePoint {
  std::array<T, 3> u;     ///< Barycentrics times sum_u.
  std::array<T, 3> u_dx;  ///< Slopes of u over the picture; constant in a triangle.
  std::array<T, 3> u_dy;
  T inverse_sum;   ///< 1 / sum u
  T inverse_area;  ///< 1 / sum e; twice the area in the picture, negative for front faces.
};

template <class T>
inline __attribute__((always_inline)) SurfacePoint<T> SurfacePointAt(const ScreenVertex<T>& p0,
                                                                     const ScreenVertex<T>& p1,
                                                                     const ScreenVertex<T>& p2, T fx, T fy) {
  const T x0 = p0.x - fx, y0 = p0.y - fy, x1 = p1.x - fx, y1 = p1.y - fy, x2 = p2.x - fx, y2 = p2.y - fy;
  const T e0 = x1 * y2 - x2 * y1, e1 = x2 * y0 - x0 * y2, e2 = x0 * y1 - x1 * y0;
  SurfacePoint<T> point;
  point.u = {e0 * p0.inverse_w, e1 * p1.inverse_w, e2 * p2.inverse_w};
  point.u_dx = {(y1 - y2) * p0.inverse_w, (y2 - y0) * p1.inverse_w, (y0 - y1) * p2.inverse_w};
  point.u_dy = {(x2 - x1) * p0.inverse_w, (x0 - x2) * p1.inverse_w, (x1 - x0) * p2.inverse_w};
  point.inverse_sum = 1 / (point.u[0] + point.u[1] + point.u[2]);
  point.inverse_area = 1 / (e0 + e1 + e2);
  return point;
}

/// Calls work(pixel, triangle's corners, fx, fy) for each pixel that shows a triangle, row by row.
template <class T, class Work>
inline __attribute__((always_inline)) void ForEachCoveredPixel(const MeshTopology& topology, const Raster<T>& raster,
                                                               const Work& work) {
  const int* triangle = raster.triangle.data();
  for (int row = 0; row < raster.height; ++row, triangle += raster.width) {
    for (int column = 0; column < raster.width; ++column) {
      if (triangle[column] < 0) continue;
      work(int64_t(row) * raster.width + column, topology.triangles[triangle[column]], T(column) + T(0.5),
           T(row) + T(0.5));
    }
  }
}

}  // namespace daumier::raster
