#include "reports/face_surface.h"

#include "core/error.h"

namespace daumier::reports {

ReportSurface SurfaceOf(const faces::FaceTemplate& face_template) {
  return {face_template.triangles, face_template.closing_triangles, face_template.num_eye_closing_triangles};
}

render::RenderInput InputOf(const ReportSurface& surface, const geometry::Points& face) {
  const int num_closing = static_cast<int>(surface.closing_triangles.rows());
  return {.surface = {face, surface.triangles},
          .closing_triangles = surface.closing_triangles,
          .closing_colours = render::ClosingColours(num_closing, surface.num_eye_closing_triangles)};
}

render::RenderInput SurfaceOf(const faces::FaceTemplate& face_template, const geometry::Points& face) {
  DAUMIER_CHECK(face.rows() == face_template.num_vertices(), "the face has {} vertices, its template {}", face.rows(),
                face_template.num_vertices());
  return InputOf(SurfaceOf(face_template), face);
}

}  // namespace daumier::reports
