#include "rig/target_carrier.h"

#include "core/error.h"
#include "core/parallel.h"
#include "geometry/nearest.h"

#include <algorithm>
#include <cmath>

namespace daumier::rig {
namespace {

constexpr double kTrusted = 0.25, kReach = 0.8;  // cm
constexpr double kStays = 3.0;                   // cm from the template.
constexpr double kAroundSlit = 1.2;              // In widths of the slit: a bag behind it may be deep.
constexpr double kTrustLimit = 1.001, kEdgeWeight = 0.05;
constexpr double kLeastTrust = 1e-9;                 // In no motion: of a part without any point.
constexpr double kFollows = 1.0, kFollowsNot = 3.0;  // cm from the skin.

/// 1 up to `from`, 0 beyond `to`, smooth between them.
double FallOff(double distance, double from, double to) {
  const double t = std::clamp((distance - from) / (to - from), 0.0, 1.0);
  return 1 - t * t * (3 - 2 * t);
}

/// What a place of the skin takes: a point of the template with its trust, or nothing; `stays`: no motion, for certain.
struct Taken {
  std::optional<geometry::SurfacePoint> point;
  double trust = 0;
  bool stays = false;
};

Taken TakenAt(const TemplateMatch& match, const geometry::Vector3& place, const geometry::Vector3& normal,
              FaceSide side) {
  const FaceSide other = OppositeSide(side);
  Taken taken;
  taken.point = match.Nearest(place, normal, kReach,
                              [&](FaceSide of_triangle) { return other == FaceSide::kNone || of_triangle != other; });
  if (taken.point) {
    taken.trust = FallOff(taken.point->distance, kTrusted, kReach);
    return taken;
  }
  if (match.NearestOfAll(place).distance < kStays) return taken;
  for (const SeamEdges& edges : match.slits()) {
    if (edges.upper.empty()) continue;
    const Eigen::RowVector3d right = match.surface().vertices.row(edges.upper.front()),
                             left = match.surface().vertices.row(edges.upper.back());
    if ((place.transpose() - 0.5 * (right + left)).norm() < kAroundSlit * (left - right).norm()) return taken;
  }
  taken.stays = true;
  return taken;
}

}  // namespace

TargetCarrier::TargetCarrier(const TemplateMatch& match, const HeadSurface& head, const HeadParts& parts,
                             const std::vector<FaceSide>& sides)
    : triangles_(match.surface().triangles), points_(size_t(head.num_places())) {
  std::vector<int> row_of(size_t(head.num_places()), -1), attached;
  for (int p = 0; p < head.num_places(); ++p) {
    const HeadPart part = parts.of_place(head, p);
    if (part == HeadPart::kAttached) attached.push_back(p);
    if (part != HeadPart::kSkin) continue;
    row_of[size_t(p)] = int(skin_.size());
    skin_.push_back(p);
  }
  trust_.resize(Eigen::Index(skin_.size()));
  Eigen::VectorXd diagonal(trust_.size());
  OnAllCores(trust_.size(), [&](int64_t i) {
    const int p = skin_[size_t(i)];
    const Taken taken = TakenAt(match, head.mesh.vertices.row(p), head.normals.row(p), sides[size_t(p)]);
    points_[size_t(p)] = taken.point;
    trust_[i] = taken.trust / (kTrustLimit - taken.trust);
    diagonal[i] = trust_[i] + (taken.stays ? 1 : 0) + kLeastTrust;
  });
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index i = 0; i < diagonal.size(); ++i) {
    const auto neighbours = head.neighbours[skin_[size_t(i)]];
    entries.emplace_back(i, i, diagonal[i] + kEdgeWeight * double(neighbours.size()));
    for (const int q : neighbours) entries.emplace_back(i, row_of[size_t(q)], -kEdgeWeight);
  }
  geometry::SparseMatrix matrix(diagonal.size(), diagonal.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  factor_.emplace(matrix);
  DAUMIER_CHECK(factor_->is_positive(), "targets cannot be carried to this head: its system has no solution");

  if (attached.empty()) return;
  const geometry::VertexTree tree(head.mesh.vertices(skin_, Eigen::all));
  for (const int p : attached) {
    const geometry::NearestVertex nearest = tree.Nearest(head.mesh.vertices.row(p));
    const double share = FallOff(nearest.distance, kFollows, kFollowsNot);
    if (share > 0) followers_.push_back({p, skin_[size_t(nearest.vertex)], float(share)});
  }
}

Eigen::MatrixXf TargetCarrier::Carry(const Eigen::MatrixXf& offsets) const {
  Eigen::MatrixXf carried = Eigen::MatrixXf::Zero(3 * std::ssize(points_), offsets.cols());
  OnAllCores(int64_t(offsets.cols()), [&](int64_t t) {
    if (offsets.col(t).isZero(0)) return;
    geometry::Points right = geometry::Points::Zero(std::ssize(skin_), 3);
    for (size_t i = 0; i < skin_.size(); ++i) {
      const auto& point = points_[size_t(skin_[i])];
      if (!point) continue;
      for (int k = 0; k < 3; ++k)
        right.row(Eigen::Index(i)) +=
            trust_[Eigen::Index(i)] * point->barycentric[k] *
            offsets.col(t).segment<3>(3 * Eigen::Index(triangles_(point->triangle, k))).cast<double>().transpose();
    }
    const geometry::Points moves = factor_->Solve(right);
    for (size_t i = 0; i < skin_.size(); ++i)
      carried.col(t).segment<3>(3 * Eigen::Index(skin_[i])) = moves.row(Eigen::Index(i)).transpose().cast<float>();
    for (const Follower& follower : followers_)
      carried.col(t).segment<3>(3 * Eigen::Index(follower.place)) =
          follower.share * carried.col(t).segment<3>(3 * Eigen::Index(follower.leader));
  });
  return carried;
}

}  // namespace daumier::rig
