#pragma once
#include "faces/face_model.h"
#include "render/shading.h"

namespace daumier::reports {

/// The surface that all faces of a report share.
struct ReportSurface {
  geometry::Triangles triangles;
  geometry::Triangles closing_triangles;  ///< Close lips and eyes in the pictures; may be empty.
  int num_eye_closing_triangles = 0;      ///< closing_triangles begins with these.
};

ReportSurface SurfaceOf(const faces::FaceTemplate& face_template);

/// A face for drawing: its surface with lips and eyes closed, the eyes whitish, the mouth dark. `face`: V x 3, cm.
render::RenderInput InputOf(const ReportSurface& surface, const geometry::Points& face);

/// The same for a face of a template. @throws Error if `face` has another number of vertices.
render::RenderInput SurfaceOf(const faces::FaceTemplate& face_template, const geometry::Points& face);

}  // namespace daumier::reports
