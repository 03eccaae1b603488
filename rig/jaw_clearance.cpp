#include "rig/jaw_clearance.h"

#include <algorithm>

namespace daumier::rig {
namespace {

constexpr double kReachOfSkin = 0.9;           // In widths of the mouth.
constexpr double kBeside = 0.25;               // cm across the line of sight.
constexpr double kDeepestGap = 2;              // cm: skin that is farther in front holds nothing back.
constexpr double kKept = 0.05, kMostPush = 1;  // cm

}  // namespace

JawClearance::JawClearance(const HeadSurface& head, const HeadParts& parts, const TemplateMatch& match)
    : vertices_(head.mesh.vertices) {
  const SeamEdges& lips = match.slits()[size_t(FaceSlit::kMouth)];
  const Eigen::RowVector3d right = match.surface().vertices.row(lips.upper.front()),
                           left = match.surface().vertices.row(lips.upper.back()), mouth = 0.5 * (right + left);
  const double reach = kReachOfSkin * (left - right).norm();
  std::vector<int> skin, teeth;
  for (int p = 0; p < head.num_places(); ++p) {
    if (parts.jaw_shares[size_t(p)] >= 0.5f) teeth.push_back(p);
    if (parts.of_place(head, p) == HeadPart::kSkin && (vertices_.row(p) - mouth).norm() <= reach) skin.push_back(p);
  }
  std::ranges::sort(skin, {}, [&](int p) { return vertices_(p, 0); });
  for (const int tooth : teeth) {
    const double x = vertices_(tooth, 0);
    auto s = std::ranges::lower_bound(skin, x - kBeside, {}, [&](int p) { return vertices_(p, 0); });
    for (; s != skin.end() && vertices_(*s, 0) <= x + kBeside; ++s) {
      const Eigen::RowVector3d from = vertices_.row(*s) - vertices_.row(tooth);
      if (std::abs(from.y()) <= kBeside && from.z() > 0 && from.z() < kDeepestGap)
        pairs_.push_back({tooth, *s, from.z()});
    }
  }
}

double JawClearance::PushOf(const Eigen::Isometry3d& jaw, const Eigen::Ref<const Eigen::VectorXf>& offsets) const {
  const Eigen::Isometry3d back = jaw.inverse();
  double push = 0;
  for (const Pair& pair : pairs_) {
    const geometry::Vector3 moved =
        vertices_.row(pair.skin).transpose() + offsets.segment<3>(3 * Eigen::Index(pair.skin)).cast<double>();
    const double gap = (back * moved).z() - vertices_(pair.tooth, 2);
    push = std::max(push, std::min(pair.gap, kKept) - gap);
  }
  return std::min(push, kMostPush);
}

}  // namespace daumier::rig
