#include "fitting/projected_curves.h"

#include "core/error.h"

#include <algorithm>

namespace daumier::fitting {
namespace {

void CheckCoordinates(const ProjectedCurves& curves, int64_t num_coordinates) {
  const int last = curves.vertices.empty() ? -1 : *std::max_element(curves.vertices.begin(), curves.vertices.end());
  DAUMIER_CHECK(num_coordinates >= 3 * (int64_t(last) + 1),
                "a face of {} coordinates has no vertex {}, which a curve passes", num_coordinates, last);
}

}  // namespace

ProjectedCurves SeeCurves(const faces::FaceTemplate& face_template, const std::vector<std::string>& names,
                          const render::Camera& camera) {
  ProjectedCurves result{.vertices = {}, .offsets = {0}, .camera = camera, .kinds = {}};
  const auto& annotated = face_template.annotation.curves;
  for (const std::string& name : names) {
    const auto curve = std::find_if(annotated.begin(), annotated.end(), [&](const auto& c) { return c.name == name; });
    DAUMIER_CHECK(curve != annotated.end(), "the template has no curve '{}', which its sketches show", name);
    result.vertices.insert(result.vertices.end(), curve->vertices.begin(), curve->vertices.end());
    if (curve->closed) result.vertices.push_back(curve->vertices.front());
    result.offsets.push_back(result.num_points());
    result.kinds.push_back(int(std::ranges::find(faces::CurveKinds(), curve->kind) - faces::CurveKinds().begin()));
  }
  return result;
}

std::vector<float> Project(const ProjectedCurves& curves, std::span<const float> face) {
  CheckCoordinates(curves, int64_t(face.size()));
  geometry::Points points(curves.num_points(), 3);
  for (Eigen::Index k = 0; k < points.rows(); ++k) {
    const float* const vertex = face.data() + 3 * curves.vertices[size_t(k)];
    points.row(k) << double(vertex[0]), double(vertex[1]), double(vertex[2]);
  }
  const geometry::Points projected = render::Project(curves.camera, points);
  std::vector<float> result;
  for (Eigen::Index k = 0; k < projected.rows(); ++k)
    result.insert(result.end(), {float(projected(k, 0)), float(projected(k, 1))});
  return result;
}

std::vector<render::Stroke> CurveStrokes(const CurveOffsets& offsets, std::span<const float> points) {
  DAUMIER_CHECK(!offsets.empty() && points.size() == 2 * size_t(offsets.back()),
                "{} coordinates for curves of {} points", points.size(), offsets.empty() ? 0 : offsets.back());
  std::vector<render::Stroke> strokes(offsets.size() - 1);
  for (size_t curve = 0; curve < strokes.size(); ++curve) {
    for (auto k = size_t(offsets[curve]); k < size_t(offsets[curve + 1]); ++k)
      strokes[curve].points.push_back({points[2 * k], points[2 * k + 1]});
  }
  return strokes;
}

std::vector<render::Stroke> SeenStrokes(const ProjectedCurves& curves, std::span<const float> face) {
  std::vector<render::Stroke> strokes = CurveStrokes(curves.offsets, Project(curves, face));
  for (size_t i = 0; i < curves.kinds.size(); ++i) strokes[i].kind = curves.kinds[i];
  return strokes;
}

ProjectedModel ProjectModel(const ProjectedCurves& curves, const faces::BilinearModel& faces) {
  const render::Camera& camera = curves.camera;
  DAUMIER_CHECK(!camera.perspective, "a bilinear face stays bilinear under an orthographic camera alone");
  CheckCoordinates(curves, faces.num_coordinates());
  ProjectedModel result;
  faces::BilinearModel& model = result.model;
  model.num_identity = faces.num_identity, model.num_expression = faces.num_expression;
  model.identity_factors = faces.identity_factors, model.expression_factors = faces.expression_factors;
  model.core.resize(faces.core.rows(), 2 * curves.num_points());
  result.constant.resize(2 * curves.num_points());
  const Eigen::Matrix<float, 2, 3> pixels_from_world =
      (camera.scale * camera.camera_from_world.topRows<2>()).cast<float>();
  const Eigen::Vector2f moved = (camera.scale * camera.translation.head<2>() + camera.principal_point).cast<float>();
  for (int k = 0; k < curves.num_points(); ++k) {
    model.core.middleCols<2>(2 * k) =
        faces.core.middleCols<3>(3 * curves.vertices[size_t(k)]) * pixels_from_world.transpose();
    result.constant.segment<2>(2 * k) = moved;
  }
  return result;
}

}  // namespace daumier::fitting
