#pragma once

#include "faces/face_model.h"
#include "rig/seam.h"

#include <vector>

namespace daumier::rig {

/// The edges of the lids of an eye, along which they meet: of the loop of the hole and the five rings of vertices around
/// it the one that leaves the least opening on the template with the eye closed. Lids without thickness have theirs at
/// the hole; lids that have one, whose hole lies behind them, at its front.
/// hole: the loop of the eye; closed: V x 3, the template with that eye closed.
/// @throws Error if the loop has fewer than four vertices.
SeamEdges FindLidEdges(const faces::FaceTemplate& face_template, const std::vector<int>& hole,
                       const geometry::Points& closed);

}  // namespace daumier::rig
