#pragma once
#include "geometry/mesh.h"
#include "geometry/topology.h"
#include "render/camera.h"
#include "render/framing.h"
#include "render/visibility.h"
#include "systems/sketch/session_curves.h"

#include <vector>

/// What a person marks on the surface that a view shows. Lengths in a view are pixels of the view's camera.
namespace daumier::sketch {

/// From where a face is seen, degrees: yaw > 0 from its own left, pitch > 0 from above, as render::TurnedCamera. The
/// side views have yaw -90 (its right side) and 90.
struct View {
  double yaw_degrees = 0, pitch_degrees = 0;
};

/// The camera whose pixels are those of a sheet. canvas: an orthographic camera that sees faces from the front, in pixels
/// of the canvas; canvas_from_sheet: the drawing's place on it. The face is turned about `pivot`, cm, which stays where
/// the front view has it. @throws Error if the canvas is in perspective or an angle is not finite.
render::Camera ViewCamera(const render::Camera& canvas, const render::Placement& canvas_from_sheet,
                          const geometry::Vector3& pivot, const View& view);

/// The part of a surface that an orthographic camera sees, by a depth map of kDepthPixels on the longer side, whatever
/// the camera's own size. A vertex is visible if a triangle of it faces the viewer and nothing lies in front of it by
/// more than two pixels' width.
class VisibleSurface {
 public:
  static constexpr int kDepthPixels = 256;

  /// @throws Error if the camera is in perspective, a vertex is not finite, or there is no vertex.
  VisibleSurface(const geometry::TriangleMesh& mesh, const render::Camera& camera);

  /// V x 3: pixels of the camera, and depth in cm.
  const geometry::Points& projected() const { return projected_; }
  const std::vector<bool>& is_visible() const { return is_visible_; }
  /// Whether nothing lies in front of points of the surface (P x 3, cm).
  std::vector<bool> Sees(const geometry::Points& points) const;

 private:
  VisibleSurface(const geometry::Points& vertices, const geometry::Points& projected,
                 const geometry::Triangles& triangles, const render::Camera& camera);
  /// front: the triangles that face the viewer.
  VisibleSurface(const geometry::TriangleMesh& front, const geometry::Points& projected, const render::Camera& camera);

  geometry::Points projected_;
  render::Visibility visibility_;
  std::vector<bool> is_visible_;
};

/// The largest connected part of the visible vertices that a stroke encloses, ascending. The stroke is closed by its
/// chord; inside is where its winding number is not 0, so that both loops of a figure of eight and an overlap of
/// the ends count. Hidden pockets (nostrils, the inside of lips) that only the region surrounds belong to it, if they
/// are enclosed and have at most kLargestPocket of its area, which the far side of a head exceeds. areas: V, cm^2.
/// @throws Error as CheckStroke, or if no visible vertex is enclosed.
std::vector<int> EnclosedRegion(const VisibleSurface& surface, const geometry::Adjacency& neighbours,
                                const Eigen::VectorXd& areas, const CanvasPoints& stroke);
inline constexpr double kLargestPocket = 0.5;

/// The visible vertices at most `radius` pixels away from a path (one point or more), ascending.
/// @throws Error if the path has no point or one that is not finite, or the radius is not positive and finite.
std::vector<int> VisibleNear(const VisibleSurface& surface, const CanvasPoints& path, double radius);

}  // namespace daumier::sketch
