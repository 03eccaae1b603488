#include "rig/ball_clearance.h"

#include <algorithm>
#include <array>

namespace daumier::rig {

void KeepOutsideBall(const Ball& ball, FaceSlit slit, const HeadSurface& head, const std::vector<FaceSide>& sides,
                     Eigen::MatrixXf& offsets) {
  constexpr double kClear = 1.01, kReach = 2.0;  // In radii.
  constexpr std::array<double, 2> kWeights = {0.5, 1.0};
  for (int p = 0; p < head.num_places(); ++p) {
    if (sides[size_t(p)] != UpperSide(slit) && sides[size_t(p)] != LowerSide(slit)) continue;
    const geometry::Vector3 rest = head.mesh.vertices.row(p).transpose() - ball.centre;
    const double at_rest = rest.norm();
    if (at_rest < ball.radius || at_rest > kReach * ball.radius) continue;
    const double least = std::min(at_rest, kClear * ball.radius);
    for (Eigen::Index t = 0; t < offsets.cols(); ++t) {
      auto offset = offsets.col(t).segment<3>(3 * Eigen::Index(p));
      if (offset.isZero(0)) continue;
      for (const double weight : kWeights) {
        const geometry::Vector3 place = rest + weight * offset.cast<double>();
        const double distance = place.norm();
        if (distance < least && distance > 0) offset += ((least / distance - 1) / weight * place).cast<float>();
      }
    }
  }
}

}  // namespace daumier::rig
