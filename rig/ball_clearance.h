#pragma once
#include "rig/head_parts.h"
#include "rig/head_surface.h"

namespace daumier::rig {

/// Changes targets so that the lids of an eye stay in front of its ball: places of the slit's sides that are outside the
/// ball at rest are moved out along rays from its centre where a target of weight 1/2 or 1 brings them nearer than 1.01
/// of its radius, or than they are at rest if that is nearer. offsets: 3P x T, in the frame of `head`.
void KeepOutsideBall(const Ball& ball, FaceSlit slit, const HeadSurface& head, const std::vector<FaceSide>& sides,
                     Eigen::MatrixXf& offsets);

}  // namespace daumier::rig
