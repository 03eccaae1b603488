#include "systems/sketch/view_selection.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace daumier::sketch {
namespace {

/// Of a stroke that marks a part of a surface, more points are not read.
constexpr size_t kMostMarkPoints = 512;

CanvasPoints MarkPoints(const CanvasPoints& stroke) {
  return stroke.size() <= kMostMarkPoints ? stroke : datasets::Resampled(stroke, int(kMostMarkPoints));
}

/// The camera's depth map: all vertices in kDepthPixels, with the camera's own axes.
render::Camera DepthCamera(const render::Camera& camera, const geometry::Points& points) {
  DAUMIER_CHECK(!camera.perspective, "a surface is marked in a view in perspective, expected an orthographic camera");
  DAUMIER_CHECK(points.rows() > 0 && points.allFinite(), "a surface of {} vertices that are not all finite",
                points.rows());
  const geometry::Points in_camera = points * camera.camera_from_world.transpose();
  const Eigen::RowVector3d low = in_camera.colwise().minCoeff(), high = in_camera.colwise().maxCoeff();
  render::Camera depth = camera;
  depth.width = depth.height = VisibleSurface::kDepthPixels;
  depth.principal_point.setConstant(0.5 * VisibleSurface::kDepthPixels);
  depth.translation = -(low + high).transpose() / 2;
  depth.scale = (VisibleSurface::kDepthPixels - 2) / std::max((high - low).head<2>().maxCoeff(), 1e-6);
  return depth;
}

/// The triangles that face the viewer. projected: y is down.
geometry::Triangles FrontTriangles(const geometry::Points& projected, const geometry::Triangles& triangles) {
  std::vector<Eigen::Index> front;
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    const Eigen::RowVector3i corners = triangles.row(f);
    const Eigen::RowVector2d a = (projected.row(corners[1]) - projected.row(corners[0])).head<2>();
    const Eigen::RowVector2d b = (projected.row(corners[2]) - projected.row(corners[0])).head<2>();
    if (a.x() * b.y() - a.y() * b.x() < 0) front.push_back(f);
  }
  return triangles(front, Eigen::all);
}

render::Visibility DepthMap(const geometry::TriangleMesh& mesh, const render::Camera& camera) {
  const render::Camera depth = DepthCamera(camera, mesh.vertices);
  return {depth, mesh, 2 / depth.scale};
}

/// How often a closed polygon winds around a point.
int WindingNumber(const CanvasPoints& polygon, const Eigen::Vector2d& point) {
  int winding = 0;
  for (size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Eigen::Vector2d a = polygon[j] - point, b = polygon[i] - point;
    const double cross = a.x() * b.y() - a.y() * b.x();
    if (a.y() <= 0 && b.y() > 0 && cross > 0) ++winding;
    if (a.y() > 0 && b.y() <= 0 && cross < 0) --winding;
  }
  return winding;
}

/// The connected parts of the vertices that count, each ascending, in the order of their lowest vertex.
std::vector<std::vector<int>> PartsOf(const geometry::Adjacency& neighbours, std::vector<bool> counts) {
  std::vector<std::vector<int>> parts;
  for (int first = 0; first < neighbours.size(); ++first) {
    if (!counts[size_t(first)]) continue;
    std::vector<int> part{first};
    counts[size_t(first)] = false;
    for (size_t next = 0; next < part.size(); ++next) {
      for (const int v : neighbours[part[next]]) {
        if (!counts[size_t(v)]) continue;
        counts[size_t(v)] = false;
        part.push_back(v);
      }
    }
    std::ranges::sort(part);
    parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace

render::Camera ViewCamera(const render::Camera& canvas, const render::Placement& canvas_from_sheet,
                          const geometry::Vector3& pivot, const View& view) {
  DAUMIER_CHECK(!canvas.perspective, "the camera of a canvas is in perspective, expected an orthographic one");
  DAUMIER_CHECK(std::isfinite(view.yaw_degrees) && std::isfinite(view.pitch_degrees),
                "a view from yaw {} and pitch {} degrees, expected finite ones", view.yaw_degrees, view.pitch_degrees);
  const render::Placement sheet_from_canvas = render::Inverse(canvas_from_sheet);
  const Eigen::Matrix3d frontal = render::Camera().camera_from_world;
  const Eigen::Matrix3d turned =
      render::TurnedCamera(pivot, 1, 1, view.yaw_degrees, view.pitch_degrees).camera_from_world;
  Eigen::Matrix3d roll = Eigen::Matrix3d::Identity();
  roll.topLeftCorner<2, 2>() = render::LinearPart(sheet_from_canvas) / sheet_from_canvas.scale;
  render::Camera camera = canvas;
  camera.camera_from_world = roll * canvas.camera_from_world * frontal.transpose() * turned;
  camera.translation =
      roll * (canvas.camera_from_world * pivot + canvas.translation) - camera.camera_from_world * pivot;
  camera.scale *= sheet_from_canvas.scale;
  camera.principal_point = render::ToCanvas(sheet_from_canvas, canvas.principal_point);
  return camera;
}

VisibleSurface::VisibleSurface(const geometry::TriangleMesh& mesh, const render::Camera& camera)
    : VisibleSurface(mesh.vertices, render::Project(camera, mesh.vertices), mesh.triangles, camera) {}

VisibleSurface::VisibleSurface(const geometry::Points& vertices, const geometry::Points& projected,
                               const geometry::Triangles& triangles, const render::Camera& camera)
    : VisibleSurface({vertices, FrontTriangles(projected, triangles)}, projected, camera) {}

VisibleSurface::VisibleSurface(const geometry::TriangleMesh& front, const geometry::Points& projected,
                               const render::Camera& camera)
    : projected_(projected), visibility_(DepthMap(front, camera)), is_visible_(size_t(projected_.rows()), false) {
  const std::vector<bool> sees = Sees(front.vertices);
  for (Eigen::Index corner = 0; corner < front.triangles.size(); ++corner) {
    const size_t v = size_t(front.triangles.data()[corner]);
    is_visible_[v] = sees[v];
  }
}

std::vector<bool> VisibleSurface::Sees(const geometry::Points& points) const {
  const geometry::Points in_depth_map = render::Project(visibility_.camera(), points);
  std::vector<bool> sees;
  for (const auto& point : in_depth_map.rowwise()) sees.push_back(visibility_.Sees(point));
  return sees;
}

std::vector<int> EnclosedRegion(const VisibleSurface& surface, const geometry::Adjacency& neighbours,
                                const Eigen::VectorXd& areas, const CanvasPoints& stroke) {
  CheckStroke(stroke);
  const CanvasPoints polygon = MarkPoints(stroke);
  const Eigen::AlignedBox2d box = datasets::BoxOf(polygon);
  const size_t num_vertices = surface.is_visible().size();
  std::vector<bool> is_enclosed(num_vertices), counts(num_vertices);
  for (size_t v = 0; v < num_vertices; ++v) {
    const Eigen::Vector2d point = surface.projected().row(Eigen::Index(v)).head<2>();
    is_enclosed[v] = box.contains(point) && WindingNumber(polygon, point) != 0;
    counts[v] = is_enclosed[v] && surface.is_visible()[v];
  }
  const std::vector<std::vector<int>> parts = PartsOf(neighbours, counts);
  DAUMIER_CHECK(!parts.empty(),
                "the stroke encloses no vertex of the visible surface; draw it around a part of the face");
  std::vector<int> region = *std::ranges::max_element(parts, {}, &std::vector<int>::size);

  std::vector<bool> is_outside(num_vertices, true);
  for (const int v : region) is_outside[size_t(v)] = false;
  const double largest_pocket = kLargestPocket * areas(region).sum();
  for (const std::vector<int>& part : PartsOf(neighbours, is_outside)) {
    const auto is_in_stroke = [&](int v) { return is_enclosed[size_t(v)]; };
    const auto touches_region = [&](int v) {
      return std::ranges::any_of(neighbours[v], [&](int near) { return !is_outside[size_t(near)]; });
    };
    if (areas(part).sum() <= largest_pocket && std::ranges::all_of(part, is_in_stroke) &&
        std::ranges::any_of(part, touches_region))
      region.insert(region.end(), part.begin(), part.end());
  }
  std::ranges::sort(region);
  return region;
}

std::vector<int> VisibleNear(const VisibleSurface& surface, const CanvasPoints& path, double radius) {
  DAUMIER_CHECK(!path.empty(), "a brush's path has no point");
  DAUMIER_CHECK(std::ranges::all_of(path, [](const Eigen::Vector2d& p) { return p.allFinite(); }),
                "a brush's path has a point that is not finite");
  DAUMIER_CHECK(radius > 0 && std::isfinite(radius), "a brush with a radius of {} pixels, expected a positive one",
                radius);
  const CanvasPoints points = MarkPoints(path);
  Eigen::AlignedBox2d box = datasets::BoxOf(points);
  box.min().array() -= radius;
  box.max().array() += radius;
  std::vector<int> found;
  for (size_t v = 0; v < surface.is_visible().size(); ++v) {
    const Eigen::Vector2d point = surface.projected().row(Eigen::Index(v)).head<2>();
    if (surface.is_visible()[v] && box.contains(point) && datasets::DistanceTo(points, point) <= radius)
      found.push_back(int(v));
  }
  return found;
}

}  // namespace daumier::sketch
