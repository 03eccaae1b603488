#include "reports/face_surface.h"

namespace daumier::reports {

ReportSurface SurfaceOf(const faces::FaceTemplate& face_template) {
  return {face_template.triangles, face_template.closing_triangles, face_template.num_eye_closing_triangles};
}

faces::FinishedHead HeadOf(const ReportSurface& surface, const geometry::Points& mean_face) {
  return {{mean_face, surface.triangles}, surface.closing_triangles, surface.num_eye_closing_triangles};
}

MaterialLook LookOf(faces::HeadMaterial material) {
  using enum faces::HeadMaterial;
  switch (material) {
    case kLidRim:
      return {{204, 168, 156}, 0.3f};
    case kSclera:
      return {{232, 229, 224}, 0.8f};
    case kLimbus:
      return {{58, 46, 40}, 0.8f};
    case kIris:
      return {{112, 82, 58}, 0.8f};
    case kPupil:
      return {{18, 16, 16}, 0.8f};
    case kInnerLip:
      return {{138, 84, 78}, 0.0f};
    case kMouth:
      return {{92, 46, 44}, 0.0f};
    case kThroat:
      return {{52, 24, 24}, 0.0f};
    case kTooth:
      return {{236, 230, 214}, 0.5f};
    case kGum:
      return {{168, 92, 88}, 0.3f};
    case kTongue:
      return {{172, 88, 84}, 0.3f};
    default:
      return {render::ShadingStyle().clay, 0.0f};
  }
}

render::RenderInput InputOf(const faces::FinishedHead& head, const geometry::Points& face) {
  render::RenderInput input{.surface = {head.Vertices(face), head.skin()}, .closing_triangles = head.parts()};
  input.is_solid = head.faces_outwards();
  for (const faces::HeadMaterial material : head.part_materials()) {
    const MaterialLook look = LookOf(material);
    input.closing_colours.push_back(look.colour);
    input.closing_gloss.push_back(look.gloss);
  }
  return input;
}

}  // namespace daumier::reports
