#include "reports/face_surface.h"

#include "core/error.h"

namespace daumier::reports {

render::RenderInput SurfaceOf(const faces::FaceTemplate& face_template, const geometry::Points& face) {
  DAUMIER_CHECK(face.rows() == face_template.num_vertices(), "the face has {} vertices, its template {}", face.rows(),
                face_template.num_vertices());
  const int num_closing = static_cast<int>(face_template.closing_triangles.rows());
  return {.surface = {face, face_template.triangles},
          .closing_triangles = face_template.closing_triangles,
          .closing_colours = render::ClosingColours(num_closing, face_template.num_eye_closing_triangles)};
}

}  // namespace daumier::reports
