#pragma once
#include "faces/controls/face_controls.h"

#include <vector>

namespace daumier::faces {

/// What artists vary without a name: smooth warps of the whole head, as controls of the group "warp". Along each axis k
/// and for all exponents of total degree n = 1 to 3 the displacement at value 1 is
///   (0.03 / n) eye spans P_a(x) P_b(y) P_c(z) e_k,
/// P Legendre polynomials and (x, y, z) the neutral template in its bounding box, scaled to [-1, 1]. Named "warp_" and
/// the axis and powers: "warp_x_yyz". Those that a symmetric face does not allow are sideways. 57 of them.
std::vector<GivenControl> SmoothWarps(const FaceTemplate& face_template);

}  // namespace daumier::faces
