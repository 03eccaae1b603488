#pragma once
#include "faces/face_model.h"
#include "render/shading.h"

namespace daumier::reports {

/// A face of a template as it is drawn: its surface with lips and eyes closed, the eyes whitish, the mouth dark.
/// `face`: V x 3, cm. @throws Error if it has another number of vertices.
render::RenderInput SurfaceOf(const faces::FaceTemplate& face_template, const geometry::Points& face);

}  // namespace daumier::reports
