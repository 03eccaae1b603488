#include "raster/interpolate.h"

#include "raster/surface_point.h"

#include <algorithm>

namespace daumier::raster {

template <class T>
void Interpolate(const MeshTopology& topology, const Raster<T>& raster, int num_channels, const T* attributes,
                 T* picture) {
  std::fill_n(picture, raster.num_pixels() * num_channels, T(0));
  ForEachCoveredPixel(topology, raster, [&](int64_t pixel, const std::array<int, 3>& corners, T, T) {
    const T b0 = raster.barycentric[2 * pixel], b1 = raster.barycentric[2 * pixel + 1], b2 = 1 - b0 - b1;
    const T *const a0 = attributes + int64_t(corners[0]) * num_channels,
                   *const a1 = attributes + int64_t(corners[1]) * num_channels,
                   *const a2 = attributes + int64_t(corners[2]) * num_channels;
    T* const to = picture + pixel * num_channels;
    for (int k = 0; k < num_channels; ++k) to[k] = b0 * a0[k] + b1 * a1[k] + b2 * a2[k];
  });
}

template <class T>
void InterpolateBackward(const MeshTopology& topology, const Raster<T>& raster, int num_channels, const T* attributes,
                         const T* picture_gradient, T* attribute_gradient, T* barycentric_gradient) {
  ForEachCoveredPixel(topology, raster, [&](int64_t pixel, const std::array<int, 3>& corners, T, T) {
    const T b0 = raster.barycentric[2 * pixel], b1 = raster.barycentric[2 * pixel + 1], b[3] = {b0, b1, 1 - b0 - b1};
    const T* const g = picture_gradient + pixel * num_channels;
    T along[3] = {};
    for (int j = 0; j < 3; ++j) {
      const int64_t first = int64_t(corners[j]) * num_channels;
      for (int k = 0; k < num_channels; ++k) along[j] += g[k] * attributes[first + k];
      if (attribute_gradient == nullptr) continue;
      for (int k = 0; k < num_channels; ++k) attribute_gradient[first + k] += b[j] * g[k];
    }
    if (barycentric_gradient == nullptr) return;
    barycentric_gradient[2 * pixel] += along[0] - along[2];
    barycentric_gradient[2 * pixel + 1] += along[1] - along[2];
  });
}

template <class T>
void InterpolateSlopes(const MeshTopology& topology, const Raster<T>& raster, int num_channels, const T* attributes,
                       T* slopes) {
  std::fill_n(slopes, raster.num_pixels() * num_channels * 2, T(0));
  ForEachCoveredPixel(topology, raster, [&](int64_t pixel, const std::array<int, 3>& corners, T fx, T fy) {
    const SurfacePoint<T> point =
        SurfacePointAt(raster.vertices[corners[0]], raster.vertices[corners[1]], raster.vertices[corners[2]], fx, fy);
    const T sum_dx = point.u_dx[0] + point.u_dx[1] + point.u_dx[2];
    const T sum_dy = point.u_dy[0] + point.u_dy[1] + point.u_dy[2];
    T* const to = slopes + pixel * num_channels * 2;
    for (int j = 0; j < 3; ++j) {
      const T b = point.u[j] * point.inverse_sum;
      const T b_dx = (point.u_dx[j] - b * sum_dx) * point.inverse_sum;
      const T b_dy = (point.u_dy[j] - b * sum_dy) * point.inverse_sum;
      const T* const a = attributes + int64_t(corners[j]) * num_channels;
      for (int k = 0; k < num_channels; ++k) {
        to[2 * k] += b_dx * a[k];
        to[2 * k + 1] += b_dy * a[k];
      }
    }
  });
}

template void Interpolate(const MeshTopology&, const Raster<float>&, int, const float*, float*);
template void Interpolate(const MeshTopology&, const Raster<double>&, int, const double*, double*);
template void InterpolateBackward(const MeshTopology&, const Raster<float>&, int, const float*, const float*, float*,
                                  float*);
template void InterpolateBackward(const MeshTopology&, const Raster<double>&, int, const double*, const double*,
                                  double*, double*);
template void InterpolateSlopes(const MeshTopology&, const Raster<float>&, int, const float*, float*);
template void InterpolateSlopes(const MeshTopology&, const Raster<double>&, int, const double*, double*);

}  // namespace daumier::raster
