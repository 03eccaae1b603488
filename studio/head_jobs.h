#pragma once
#include "studio/job_options.h"
#include "studio/job_plans.h"

namespace daumier::studio {

/// Jobs of verbs that make rigged heads, as children.

/// `daumier rig` of the face of a request.
NewJob PlanHead(const Json& body, const JobMaterial& material);
/// `daumier avatar` of the upload or the drawing of a request; of a session whose face was changed since it was drawn, `daumier rig` of that face.
NewJob PlanAvatar(const Json& body, const JobMaterial& material);

/// `daumier avatar` as PlanAvatar, then the mesh of its head (WriteHeadMesh) instead of the head.
NewJob PlanAvatarMesh(const Json& avatar, const std::string& format, const JobMaterial& material);
/// Likewise a turntable of its head.
NewJob PlanAvatarTurntable(const Json& avatar, const TurntableOptions& options, const JobMaterial& material);

/// Writes a face of the template as OBJ.
void WriteFace(const std::filesystem::path& file, const geometry::Points& face, const JobMaterial& material);

}  // namespace daumier::studio
