#include "datasets/build/portrait_lines.h"

#include "geometry/normals.h"
#include "render/contour_strokes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <set>
#include <string>

namespace daumier::datasets {
namespace {

constexpr double kToleranceMm = 1.5;
constexpr double kShortestPixels = 6;

/// Inked as lines of a drawing; the silhouette comes from the view, and brows have hair.
const std::set<std::string>& InkedKinds() {
  static const std::set<std::string> kinds = {"upper_eye", "upper_mouth", "lower_mouth", "ear", "nose"};
  return kinds;
}

/// A surface whose radial curvature is positive everywhere: contours for which it is not lie inside of the surface,
/// where visibility removes them, so that curvature need not be computed.
render::ContourSurface RoundSurface(geometry::TriangleMesh mesh) {
  render::ContourSurface surface;
  const Eigen::Index n = mesh.vertices.rows();
  geometry::PrincipalCurvatures& curvatures = surface.curvatures;
  curvatures.normals = geometry::VertexNormals(mesh);
  curvatures.k1 = curvatures.k2 = Eigen::VectorXd::Ones(n);
  curvatures.direction1.resize(n, 3);
  curvatures.direction2.resize(n, 3);
  for (Eigen::Index v = 0; v < n; ++v) {
    const geometry::Vector3 normal = curvatures.normals.row(v);
    const geometry::Vector3 first = normal.unitOrthogonal();
    curvatures.direction1.row(v) = first;
    curvatures.direction2.row(v) = normal.cross(first);
  }
  surface.derivatives = geometry::CurvatureDerivatives::Zero(n, 4);
  surface.mesh = std::move(mesh);
  return surface;
}

void AddVisible(const geometry::Points& projected, const render::Visibility& visibility,
                std::vector<render::Stroke>& strokes) {
  bool continues = false;
  for (Eigen::Index i = 1; i < projected.rows(); ++i) {
    if (!visibility.Sees(0.5 * (projected.row(i - 1) + projected.row(i)))) {
      continues = false;
      continue;
    }
    const auto pixel = [&](Eigen::Index p) -> std::array<float, 2> {
      return {static_cast<float>(projected(p, 0)), static_cast<float>(projected(p, 1))};
    };
    if (!continues) strokes.push_back({0, {pixel(i - 1)}});
    strokes.back().points.push_back(pixel(i));
    continues = true;
  }
}

}  // namespace

PortraitLines::PortraitLines(const faces::FaceTemplate& face_template)
    : triangles_(face_template.triangles), tolerance_(kToleranceMm / faces::MillimetresPerCm(face_template)) {
  for (const faces::FeatureCurve& curve : face_template.annotation.curves) {
    if (curve.view != faces::View::kFrontal || curve.vertices.empty() || !InkedKinds().contains(curve.kind)) continue;
    curves_.push_back(curve.vertices);
    if (curve.closed) curves_.back().push_back(curve.vertices.front());
  }
}

std::vector<render::Stroke> PortraitLines::Draw(const geometry::Points& face, const render::Camera& camera,
                                                const render::PictureBuffers& buffers) const {
  render::Raster depth{.height = buffers.height, .width = buffers.width};
  depth.depth.assign(buffers.depth.begin(), buffers.depth.end());
  const render::Visibility visibility(camera, std::move(depth), tolerance_);
  render::ContourOptions options;
  options.min_length = kShortestPixels;
  std::vector<render::Stroke> strokes =
      render::OccludingStrokes(RoundSurface({face, triangles_}), visibility, options, 0);
  for (const std::vector<int>& curve : curves_)
    AddVisible(render::Project(camera, face(curve, Eigen::all)), visibility, strokes);
  return strokes;
}

}  // namespace daumier::datasets
