#include "raster/rasterise.h"

#include "raster/surface_point.h"

namespace daumier::raster {

template <class T>
void Rasterise(const MeshTopology& topology, const T* positions, int height, int width, Facing facing,
               Raster<T>& raster) {
  FindVisibleTriangles(topology, positions, height, width, facing, raster);
  raster.barycentric.assign(2 * raster.num_pixels(), T(0));
  ForEachCoveredPixel(topology, raster, [&](int64_t pixel, const std::array<int, 3>& corners, T fx, T fy) {
    const SurfacePoint<T> point =
        SurfacePointAt(raster.vertices[corners[0]], raster.vertices[corners[1]], raster.vertices[corners[2]], fx, fy);
    raster.barycentric[2 * pixel] = point.u[0] * point.inverse_sum;
    raster.barycentric[2 * pixel + 1] = point.u[1] * point.inverse_sum;
  });
}

template <class T>
void RasteriseBackward(const MeshTopology& topology, const Raster<T>& raster, const T* barycentric_gradient,
                       T* position_gradient) {
  ForEachCoveredPixel(topology, raster, [&](int64_t pixel, const std::array<int, 3>& corners, T fx, T fy) {
    const T g0 = barycentric_gradient[2 * pixel], g1 = barycentric_gradient[2 * pixel + 1];
    if (g0 == 0 && g1 == 0) return;
    const SurfacePoint<T> point =
        SurfacePointAt(raster.vertices[corners[0]], raster.vertices[corners[1]], raster.vertices[corners[2]], fx, fy);
    const T b0 = raster.barycentric[2 * pixel], b1 = raster.barycentric[2 * pixel + 1];
    const T mean = g0 * b0 + g1 * b1;
    const T dx = point.u_dx[0] * (g0 - mean) + point.u_dx[1] * (g1 - mean) - point.u_dx[2] * mean;
    const T dy = point.u_dy[0] * (g0 - mean) + point.u_dy[1] * (g1 - mean) - point.u_dy[2] * mean;
    const T qx = -dx * point.inverse_area, qy = -dy * point.inverse_area, qw = -(fx * qx + fy * qy);
    const T b[3] = {b0, b1, 1 - b0 - b1};
    for (int k = 0; k < 3; ++k) {
      T* const to = position_gradient + 4 * int64_t(corners[k]);
      to[0] += b[k] * qx;
      to[1] += b[k] * qy;
      to[3] += b[k] * qw;
    }
  });
}

template void Rasterise(const MeshTopology&, const float*, int, int, Facing, Raster<float>&);
template void Rasterise(const MeshTopology&, const double*, int, int, Facing, Raster<double>&);
template void RasteriseBackward(const MeshTopology&, const Raster<float>&, const float*, float*);
template void RasteriseBackward(const MeshTopology&, const Raster<double>&, const double*, double*);

}  // namespace daumier::raster
