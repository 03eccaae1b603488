#include "render/mesh_drawing.h"

#include "core/error.h"
#include "core/log.h"
#include "geometry/debris.h"
#include "geometry/orientation.h"
#include "geometry/polygon_collector.h"
#include "geometry/submesh.h"
#include "geometry/triangulate.h"
#include "geometry/weld.h"

#include <fmt/ranges.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <string>

namespace daumier::render {
namespace {

/// Half the height of a frame, up to a factor of two: about that of a head in cm, which limits of cameras assume.
constexpr int kFrameExponent = 3;

Eigen::Vector3d VectorOf(AxisDirection direction) {
  const int index = static_cast<int>(direction);
  return (index % 2 == 0 ? 1.0 : -1.0) * Eigen::Vector3d::Unit(index / 2);
}

/// Scales by a power of two, which is exact, so that `size` gets the binary exponent `exponent`.
void ScaleTo(double size, int exponent, geometry::Points& points) {
  const int shift = exponent - std::ilogb(size);
  points = points.unaryExpr([&](double x) { return std::scalbn(x, shift); });
}

/// The triangles of the polygons in the upright frame with the vertices that they use, at most 1 in size.
geometry::TriangleMesh UprightSurface(const geometry::PolygonMesh& mesh, const Eigen::Matrix3d& upright_from_file,
                                      std::string_view name) {
  DAUMIER_CHECK(!mesh.corners.empty(), "{}: has no faces (found {} vertices, expected polygons)", name,
                mesh.vertices.rows());
  geometry::PolygonMesh upright =
      geometry::Submesh(mesh, geometry::MapKept(mesh.corners, static_cast<int>(mesh.vertices.rows())));
  geometry::CheckFinite(upright.vertices, name);
  const double size = upright.vertices.cwiseAbs().maxCoeff();
  if (size > 0) ScaleTo(size, 0, upright.vertices);
  upright.vertices *= upright_from_file.transpose();
  return {upright.vertices, geometry::Triangulate(upright)};
}

/// Of a surface in the frame of its file.
void HintAtUp(const geometry::TriangleMesh& surface, std::string_view name) {
  constexpr double kDeep = 1.05;
  const Eigen::RowVector3d extent = surface.vertices.colwise().maxCoeff() - surface.vertices.colwise().minCoeff();
  if (extent.z() > kDeep * extent.y())
    log::Info("{}: it is {:.1f} times as long along z as along y. If the drawing shows the top of a head, add --up z",
              name, extent.z() / extent.y());
}

}  // namespace

AxisDirection FrontFor(AxisDirection up) {
  switch (up) {
    case AxisDirection::kZ:
      return AxisDirection::kMinusY;
    case AxisDirection::kMinusY:
      return AxisDirection::kMinusZ;
    case AxisDirection::kMinusZ:
      return AxisDirection::kY;
    default:
      return AxisDirection::kZ;
  }
}

Eigen::Matrix3d UprightFromFile(AxisDirection up, AxisDirection front) {
  const Eigen::Vector3d y = VectorOf(up), z = VectorOf(front);
  if (y.dot(z) != 0) throw UsageError("up and front of a mesh lie on one axis, expected two different ones");
  Eigen::Matrix3d rotation;
  rotation << y.cross(z).transpose(), y.transpose(), z.transpose();
  return rotation;
}

std::vector<Stroke> DrawMesh(const geometry::PolygonMesh& mesh, const MeshView& view, const ContourOptions& options,
                             std::string_view name) {
  const AxisDirection up = view.up.value_or(AxisDirection::kY);
  const Eigen::Matrix3d rotation = UprightFromFile(up, view.front.value_or(FrontFor(up)));
  geometry::TriangleMesh surface = UprightSurface(mesh, rotation, name);
  const auto rows = mesh.vertices.rowwise();
  const auto num_finite = std::count_if(rows.begin(), rows.end(), [](const auto& p) { return p.allFinite(); });
  const auto num_unused = num_finite - surface.vertices.rows();
  surface = geometry::WeldedSurface(surface, geometry::WeldTolerance(surface.vertices));
  DAUMIER_CHECK(
      surface.triangles.rows() > 0,
      "{}: no triangle has its corners in three places (found {} vertices in one point or two, expected a surface)",
      name, mesh.vertices.rows());
  geometry::CleanSurface clean = geometry::RemoveDebris(surface);
  surface = std::move(clean.mesh);
  const geometry::OrientedSurface oriented = geometry::OrientOutwards(surface);
  surface.triangles = oriented.triangles;

  std::vector<std::string> repairs;
  if (num_unused > 0) repairs.push_back(fmt::format("{} vertices that no polygon uses are ignored", num_unused));
  if (clean.num_pieces_removed > 0)
    repairs.push_back(fmt::format("{} small pieces far away are left out", clean.num_pieces_removed));
  if (oriented.num_turned == surface.triangles.rows()) {
    repairs.push_back("it is inside out, so all triangles are turned");
  } else if (oriented.num_turned > 0) {
    repairs.push_back(fmt::format("{} of {} triangles are wound the wrong way and are turned", oriented.num_turned,
                                  surface.triangles.rows()));
  }
  if (!repairs.empty()) log::Warn("{}: {}", name, fmt::join(repairs, "; "));

  if (!view.up && !view.front) HintAtUp(surface, name);

  const double half_height = FrameOf(surface.vertices).half_height;
  DAUMIER_CHECK(half_height > 0, "{}: all vertices lie in one point", name);
  ScaleTo(half_height, kFrameExponent, surface.vertices);
  const Frame frame = FrameOf(surface.vertices);
  Camera camera = TurnedCamera(frame.centre, frame.half_height, kSketchCanvas, view.yaw_degrees, view.pitch_degrees);
  if (view.distance) camera = WithPerspective(camera, *view.distance * 2 * frame.half_height);
  std::vector<Stroke> strokes = DrawContours(surface, camera, options);
  DAUMIER_CHECK(!strokes.empty(),
                "{}: no line of its {} triangles is visible from here (expected contours or borders). Draw it from "
                "another side (--yaw, --pitch, --up), or lower min_length and high.",
                name, surface.triangles.rows());
  return strokes;
}

}  // namespace daumier::render
