#include "raster/camera.h"

namespace daumier::raster {

template <class T>
void Project(const Camera& camera, int64_t num_points, const T* points, T* positions) {
  const T focal = T(camera.focal), cx = T(camera.centre_x), cy = T(camera.centre_y), distance = T(camera.distance);
  const bool perspective = camera.projection == Camera::Projection::kPerspective;
  for (int64_t i = 0; i < num_points; ++i) {
    const T *const p = points + 3 * i, w = perspective ? distance - p[2] : T(1);
    T* const to = positions + 4 * i;
    to[0] = cx * w + focal * p[0];
    to[1] = cy * w - focal * p[1];
    to[2] = -focal * p[2];  // In perspective focal (w - distance), too.
    to[3] = w;
  }
}

template <class T>
void ProjectBackward(const Camera& camera, int64_t num_points, const T* position_gradient, T* point_gradient) {
  const T focal = T(camera.focal), cx = T(camera.centre_x), cy = T(camera.centre_y);
  const T w_slope = camera.projection == Camera::Projection::kPerspective ? T(-1) : T(0);
  for (int64_t i = 0; i < num_points; ++i) {
    const T* const g = position_gradient + 4 * i;
    T* const to = point_gradient + 3 * i;
    to[0] += focal * g[0];
    to[1] -= focal * g[1];
    to[2] += w_slope * (cx * g[0] + cy * g[1] + g[3]);
  }
}

template void Project(const Camera&, int64_t, const float*, float*);
template void Project(const Camera&, int64_t, const double*, double*);
template void ProjectBackward(const Camera&, int64_t, const float*, float*);
template void ProjectBackward(const Camera&, int64_t, const double*, double*);

}  // namespace daumier::raster
