#pragma once
#include "geometry/mesh.h"
#include "render/contour_strokes.h"

#include <optional>
#include <string_view>

namespace daumier::render {

/// A direction along an axis of a mesh.
enum class AxisDirection { kX, kMinusX, kY, kMinusY, kZ, kMinusZ };

/// From where a mesh of a file is drawn.
struct MeshView {
  std::optional<AxisDirection> up;     ///< Absent: y, with a hint where z seems to point upwards.
  std::optional<AxisDirection> front;  ///< Where the face looks to; absent: as FrontFor.
  double yaw_degrees = 0, pitch_degrees = 0;
  std::optional<double> distance;  ///< Of a perspective camera, in heights of the mesh; absent: orthographic.
};

/// Where a face looks to in the usual frames with that direction upwards: up y and front z turned about x, so that up z
/// has the front -y (Blender), up -y the front -z (pictures), up -z the front y; up x and -x have the front z.
AxisDirection FrontFor(AxisDirection up);

/// The rotation that takes `up` to +y and `front` to +z. @throws UsageError if they are not perpendicular.
Eigen::Matrix3d UprightFromFile(AxisDirection up, AxisDirection front);

/// A line drawing of the mesh of a file (DrawContours) from the middle of its surface, whatever its unit: strokes on the
/// canvas. Drawn is its WeldedSurface without debris (RemoveDebris), wound outwards (OrientOutwards). One warning says
/// that changed, other than welding. A message hints at --up z where `up` is absent and the surface is more than 1.05
/// times as deep (z) as high (y): heads and masks of faces have 0.4 to 0.95, with z upwards 1.05 to 2.3. `name` names the
/// mesh in messages.
/// @throws Error "name: problem" if there is no triangle, all vertices lie in one point, or no line is visible; and as
/// DrawContours. UsageError as UprightFromFile.
std::vector<Stroke> DrawMesh(const geometry::PolygonMesh& mesh, const MeshView& view, const ContourOptions& options,
                             std::string_view name);

}  // namespace daumier::render
