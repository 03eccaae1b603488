#pragma once
#include "geometry/line_cut.h"
#include "rig/seam_line.h"

namespace daumier::rig {

/// Adds a pocket behind a cut along a line to its mesh, that begins at both sides of it, with vertices of its own: in the frame of the line back by 0.45 of
/// its width, narrower and, between the corners, higher on the way; its sides end in one edge. It is seen from the slit. Each
/// corner has the UV of the place of the cut that it continues. `sources` of the pocket are -1.
void AddPocket(const SeamLine& line, geometry::LineCut& cut);

}  // namespace daumier::rig
