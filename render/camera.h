#pragma once
#include "geometry/mesh.h"

#include <Eigen/Core>

namespace daumier::render {

/// p_camera = camera_from_world * p_world + translation, with x to the right, y down and z away from the viewer, in cm.
/// In pixels, orthographic: (x, y) * scale + principal_point; perspective: (x, y) / z * scale + principal_point. The
/// picture's origin is the upper left corner of its upper left pixel, whose centre is (0.5, 0.5).
struct Camera {
  Eigen::Matrix3d camera_from_world =
      Eigen::Vector3d(1, -1, -1).asDiagonal();  ///< A rotation; the default looks along -z.
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  bool perspective = false;
  double scale = 1.0;  ///< Orthographic: pixels a cm. Perspective: focal length in pixels.
  Eigen::Vector2d principal_point = Eigen::Vector2d::Zero();
  int width = 0, height = 0;
};

/// What a picture shows: a cube around `centre` with sides of 2 half_height cm.
struct Frame {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double half_height = 1.0;
};

/// The cube about the middle of the points' bounding box that holds all of them, made larger by the margin. Give it the
/// points of all faces of a sheet, so that one scale serves all. @throws Error if there are no points or one is not
/// finite.
Frame FrameOf(const geometry::Points& points, double margin = 1.08);

/// Looks at a face that looks to +z from the front: world +x, the face's own left, is on the right of the picture; +y
/// is up. Orthographic, size x size pixels, centre in the middle, top and bottom half_height_cm away from it.
/// @throws Error if half_height_cm or size is not positive.
Camera FrontalCamera(const Eigen::Vector3d& centre, double half_height_cm, int size);

/// Looks at the face's own right side from -x: the profile looks to the right of the picture, where world +z is.
Camera SideCamera(const Eigen::Vector3d& centre, double half_height_cm, int size);

/// The frontal camera moved around the centre: by yaw > 0 towards the face's own left (+x), by pitch > 0 upwards. Yaw
/// -90 is the side view. Depth is 0 at the centre.
Camera TurnedCamera(const Eigen::Vector3d& centre, double half_height_cm, int size, double yaw_degrees,
                    double pitch_degrees = 0.0);

/// An orthographic camera made to see in perspective from a distance: what lies at depth 0 keeps its place and size,
/// and gets the depth `distance_cm`. @throws Error if the camera is in perspective already or the distance is not
/// positive.
Camera WithPerspective(const Camera& camera, double distance_cm);

/// The same view in factor times as many pixels a side. @throws Error if the factor is not positive.
Camera Enlarged(const Camera& camera, int factor);

/// P x 3: x and y in pixels, and the depth along the camera's axis in cm, which grows away from the viewer. In
/// perspective, points at depth <= 0 are behind the viewer, and their x and y mean nothing.
geometry::Points Project(const Camera& camera, const geometry::Points& points);

}  // namespace daumier::render
