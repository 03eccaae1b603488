#pragma once
#include "faces/finished_head.h"
#include "render/shading.h"

namespace daumier::reports {

/// The surface that all faces of a report share.
struct ReportSurface {
  geometry::Triangles triangles;
  geometry::Triangles closing_triangles;  ///< Close lips and eyes; may be empty.
  int num_eye_closing_triangles = 0;      ///< closing_triangles begins with these.
};

ReportSurface SurfaceOf(const faces::FaceTemplate& face_template);

/// What pictures show of the faces of a report. `mean_face`: V x 3, cm; its neck decides where all of them are cut.
/// @throws Error as faces::FinishedHead.
faces::FinishedHead HeadOf(const ReportSurface& surface, const geometry::Points& mean_face);

/// How a material looks: its colour, and the strength of its highlight (render::RenderInput::closing_gloss).
struct MaterialLook {
  render::Rgb colour;
  float gloss = 0;
};
MaterialLook LookOf(faces::HeadMaterial material);

/// A face for drawing: its finished head. `face`: V x 3, cm. @throws Error as faces::FinishedHead::Vertices.
render::RenderInput InputOf(const faces::FinishedHead& head, const geometry::Points& face);

}  // namespace daumier::reports
