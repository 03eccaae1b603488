#include "rig/carry_targets.h"

#include "core/error.h"
#include "core/parallel.h"
#include "geometry/nearest.h"
#include "geometry/path.h"
#include "geometry/sparse_factor.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace daumier::rig {
namespace {

constexpr double kTrusted = 0.25, kFarthest = 0.8;  // cm
constexpr double kStays = 3.0;                      // cm from the template.
constexpr double kAroundSlit = 1.2;                 // In widths of the slit: a bag behind it may be deep.
constexpr double kTrustLimit = 1.001, kEdgeWeight = 0.05;
constexpr double kLeastTrust = 1e-9;                               // In no motion: of a part without any point.
constexpr double kTears = 2, kLeastTear = 0.15, kTearReach = 0.6;  // Of an edge's length; cm; cm.
constexpr double kFollows = 1.0, kFollowsNot = 3.0;                // cm from the skin.

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
  taken.point = match.Nearest(place, normal, kFarthest,
                              [&](FaceSide of_triangle) { return other == FaceSide::kNone || of_triangle != other; });
  if (taken.point) {
    taken.trust = FallOff(taken.point->distance, kTrusted, kFarthest);
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

/// The skin of a head and what its places take.
struct CarriedSkin {
  std::vector<int> places;         ///< Ascending.
  std::vector<int> rows;           ///< P: where each place is among them; -1.
  std::vector<Taken> taken;        ///< One a place of the skin.
  geometry::Adjacency neighbours;  ///< Of rows.
};

CarriedSkin SkinOf(const TemplateMatch& match, const HeadSurface& head, const HeadParts& parts,
                   const std::vector<FaceSide>& sides) {
  CarriedSkin skin;
  skin.rows.assign(size_t(head.num_places()), -1);
  for (int p = 0; p < head.num_places(); ++p) {
    if (parts.of_place(head, p) != HeadPart::kSkin) continue;
    skin.rows[size_t(p)] = int(skin.places.size());
    skin.places.push_back(p);
  }
  skin.taken.resize(skin.places.size());
  OnAllCores(std::ssize(skin.places), [&](int64_t i) {
    const int p = skin.places[size_t(i)];
    skin.taken[size_t(i)] = TakenAt(match, head.mesh.vertices.row(p), head.normals.row(p), sides[size_t(p)]);
  });
  for (const int p : skin.places) {
    for (const int q : head.neighbours[p]) skin.neighbours.values.push_back(skin.rows[size_t(q)]);
    skin.neighbours.offsets.push_back(int(skin.neighbours.values.size()));
  }
  return skin;
}

/// m of the places of the skin, for one target; 0 where they have no point.
geometry::Points TakenOffsets(const CarriedSkin& skin, const geometry::Triangles& triangles,
                              const Eigen::Ref<const Eigen::VectorXf>& offsets) {
  geometry::Points moves = geometry::Points::Zero(std::ssize(skin.places), 3);
  for (size_t i = 0; i < skin.places.size(); ++i) {
    const auto& point = skin.taken[i].point;
    if (!point) continue;
    for (int k = 0; k < 3; ++k)
      moves.row(Eigen::Index(i)) +=
          point->barycentric[k] *
          offsets.segment<3>(3 * Eigen::Index(triangles(point->triangle, k))).cast<double>().transpose();
  }
  return moves;
}

/// Takes trust away around edges that join what a slit of the template keeps apart.
void DistrustTears(const TemplateMatch& match, const HeadSurface& head, CarriedSkin& skin) {
  const geometry::Points points = head.mesh.vertices(skin.places, Eigen::all);
  const auto triangle = [&](int i) {
    const auto& point = skin.taken[size_t(i)].point;
    return point ? point->triangle : -1;
  };
  std::vector<int> torn;
  for (int i = 0; i < int(skin.places.size()); ++i) {
    const int of_place = triangle(i);
    if (of_place < 0 || match.side(of_place) == FaceSide::kNone) continue;
    const bool is_torn = std::ranges::any_of(skin.neighbours[i], [&](int j) {
      const int other = triangle(j);
      if (other < 0 || match.side(other) != OppositeSide(match.side(of_place))) return false;
      const double length = (points.row(i) - points.row(j)).norm();
      return std::min(match.WayAcross(of_place), match.WayAcross(other)) > kTears * length + kLeastTear;
    });
    if (is_torn) torn.push_back(i);
  }
  const auto nearest = geometry::FindNearestSeeds(points, skin.neighbours, torn, kTearReach);
  for (size_t i = 0; i < skin.taken.size(); ++i)
    if (nearest.seeds[i] >= 0) skin.taken[i].trust *= 1 - FallOff(nearest.distances[i], 0, kTearReach);
}

double WeightOf(const Taken& taken) {
  return taken.trust / (kTrustLimit - taken.trust);
}

geometry::SparseMatrix SystemOf(const CarriedSkin& skin) {
  const int size = int(skin.places.size());
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < size; ++i) {
    const auto neighbours = skin.neighbours[i];
    const Taken& taken = skin.taken[size_t(i)];
    entries.emplace_back(
        i, i, WeightOf(taken) + (taken.stays ? 1 : 0) + kLeastTrust + kEdgeWeight * double(neighbours.size()));
    for (const int j : neighbours) entries.emplace_back(i, j, -kEdgeWeight);
  }
  geometry::SparseMatrix matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// A place of an attached part and the place of the skin that it follows.
struct Follower {
  int place, leader;
  float share;
};

std::vector<Follower> FollowersOf(const HeadSurface& head, const HeadParts& parts, const std::vector<int>& skin) {
  std::vector<Follower> followers;
  const geometry::VertexTree tree(head.mesh.vertices(skin, Eigen::all));
  for (int p = 0; p < head.num_places(); ++p) {
    if (parts.of_place(head, p) != HeadPart::kAttached) continue;
    const geometry::NearestVertex nearest = tree.Nearest(head.mesh.vertices.row(p));
    const double share = FallOff(nearest.distance, kFollows, kFollowsNot);
    if (share > 0) followers.push_back({p, skin[size_t(nearest.vertex)], float(share)});
  }
  return followers;
}

}  // namespace

Eigen::MatrixXf CarryTargets(const TemplateMatch& match, const HeadSurface& head, const HeadParts& parts,
                             const std::vector<FaceSide>& sides, const Eigen::MatrixXf& offsets) {
  CarriedSkin skin = SkinOf(match, head, parts, sides);
  DistrustTears(match, head, skin);
  const geometry::SparseFactor factor(SystemOf(skin));
  DAUMIER_CHECK(factor.is_positive(), "targets cannot be carried to this head: its system has no solution");
  const std::vector<Follower> followers = FollowersOf(head, parts, skin.places);

  Eigen::MatrixXf carried = Eigen::MatrixXf::Zero(3 * Eigen::Index(head.num_places()), offsets.cols());
  OnAllCores(offsets.cols(), [&](int64_t t) {
    if (offsets.col(t).isZero(0)) return;
    geometry::Points right = TakenOffsets(skin, match.surface().triangles, offsets.col(t));
    for (size_t i = 0; i < skin.places.size(); ++i) right.row(Eigen::Index(i)) *= WeightOf(skin.taken[i]);
    const geometry::Points solved = factor.Solve(right);
    for (size_t i = 0; i < skin.places.size(); ++i)
      carried.col(t).segment<3>(3 * Eigen::Index(skin.places[i])) =
          solved.row(Eigen::Index(i)).transpose().cast<float>();
    for (const Follower& follower : followers)
      carried.col(t).segment<3>(3 * Eigen::Index(follower.place)) =
          follower.share * carried.col(t).segment<3>(3 * Eigen::Index(follower.leader));
  });
  return carried;
}

}  // namespace daumier::rig
