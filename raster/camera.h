#pragma once
#include <cstdint>

namespace daumier::raster {

/// From a point in cm (x right, y up, z to the viewer) to homogeneous pixel coordinates (X, Y, Z, w): the picture shows
/// it at (X / w, Y / w), with depth Z / w growing away from the viewer. The picture's origin is the upper left corner of
/// its upper left pixel.
///   perspective:   w = distance - z,  X = centre_x w + focal x,  Y = centre_y w - focal y,  Z = focal (w - distance)
///   orthographic:  w = 1,             X = centre_x + focal x,    Y = centre_y - focal y,    Z = -focal z
/// The unit of depth is about one pixel: exactly so in orthographic views, and at z = 0 in perspective.
struct Camera {
  enum class Projection { kPerspective, kOrthographic };
  Projection projection = Projection::kPerspective;
  double focal = 1015;                    ///< Perspective: pixels. Orthographic: pixels a cm.
  double centre_x = 112, centre_y = 112;  ///< Pixels.
  double distance = 100;                  ///< From the viewer to the origin, cm; not used by orthographic cameras.
  int height = 224, width = 224;          ///< Pixels.

  bool operator==(const Camera&) const = default;
};

/// points: num_points x 3. positions: num_points x 4, written. T is float or double.
template <class T>
void Project(const Camera& camera, int64_t num_points, const T* points, T* positions);

/// Adds to point_gradient (num_points x 3) the gradient of sum(positions * position_gradient); position_gradient:
/// num_points x 4, of which the third column is not read: depth carries no gradient.
template <class T>
void ProjectBackward(const Camera& camera, int64_t num_points, const T* position_gradient, T* point_gradient);

}  // namespace daumier::raster
