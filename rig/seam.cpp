#include "rig/seam.h"

#include "core/error.h"
#include "geometry/topology.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace daumier::rig {
namespace {

std::vector<double> SharesOfLength(const geometry::Points& points, const std::vector<int>& path) {
  std::vector<double> shares = {0};
  for (size_t i = 1; i < path.size(); ++i)
    shares.push_back(shares.back() + (points.row(path[i]) - points.row(path[i - 1])).norm());
  DAUMIER_CHECK(shares.back() > 0, "the edge of a seam has no length");
  const double length = shares.back();
  for (double& share : shares) share /= length;
  return shares;
}

/// For each inner share of `coarse` the place of the share of `fine` that it is matched to: ascending, least squares.
/// By dynamic programming over cost(i, j) of the first i matched to the first j.
std::vector<size_t> Matches(const std::vector<double>& coarse, const std::vector<double>& fine) {
  const size_t num_coarse = coarse.size() - 2, num_fine = fine.size() - 2;
  constexpr double kNever = std::numeric_limits<double>::infinity();
  std::vector<std::vector<double>> cost(num_coarse + 1, std::vector<double>(num_fine + 1, kNever));
  cost[0].assign(num_fine + 1, 0);
  const auto with = [&](size_t i, size_t j) { return cost[i - 1][j - 1] + std::pow(coarse[i] - fine[j], 2); };
  for (size_t i = 1; i <= num_coarse; ++i)
    for (size_t j = i; j <= num_fine; ++j) cost[i][j] = std::min(cost[i][j - 1], with(i, j));
  std::vector<size_t> matches(num_coarse);
  for (size_t i = num_coarse, j = num_fine; i > 0; --j)
    if (cost[i][j] == with(i, j)) matches[--i] = j;
  return matches;
}

/// Shares of the finer edge that are those of the coarser one where they match, and between divide its length.
std::vector<double> MatchedShares(const std::vector<double>& coarse, const std::vector<double>& fine) {
  std::vector<double> shares(fine.size());
  const std::vector<size_t> matches = Matches(coarse, fine);
  size_t from = 0;
  for (size_t i = 0; i + 1 < coarse.size(); ++i) {
    const size_t to = i < matches.size() ? matches[i] : fine.size() - 1;
    for (size_t j = from; j <= to; ++j)
      shares[j] =
          coarse[i] + (coarse[i + 1] - coarse[i]) * (fine[j] - fine[from]) / std::max(fine[to] - fine[from], 1e-12);
    from = to;
  }
  return shares;
}

double DistanceToPath(const Eigen::Vector3d& point, const geometry::Points& pose, const std::vector<int>& path) {
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 1; i < path.size(); ++i) {
    const Eigen::Vector3d a = pose.row(path[i - 1]).transpose(), edge = pose.row(path[i]).transpose() - a;
    const double t = std::clamp((point - a).dot(edge) / std::max(edge.squaredNorm(), 1e-30), 0.0, 1.0);
    least = std::min(least, (point - a - t * edge).norm());
  }
  return least;
}

}  // namespace

SeamFrame FrameOfSeam(const SeamEdges& edges, const geometry::Points& points, const Eigen::Vector3d& towards) {
  SeamFrame frame;
  frame.along = (points.row(edges.upper.back()) - points.row(edges.upper.front())).normalized();
  frame.out = (towards - towards.dot(frame.along) * frame.along).normalized();
  frame.up = frame.out.cross(frame.along);
  return frame;
}

Seam::Seam(const geometry::TriangleMesh& neutral, SeamEdges edges, int num_rings)
    : edges_(std::move(edges)), num_rings_(num_rings) {
  const std::vector<int>&upper = edges_.upper, &lower = edges_.lower;
  DAUMIER_CHECK(upper.size() >= 3 && lower.size() >= 3, "a seam has edges of {} and {} vertices, expected 3 or more",
                upper.size(), lower.size());
  DAUMIER_CHECK(upper.front() == lower.front() && upper.back() == lower.back(),
                "the edges of a seam end at vertices {}, {} and {}, {}, expected the same corners", upper.front(),
                upper.back(), lower.front(), lower.back());
  upper_shares_ = SharesOfLength(neutral.vertices, upper);
  lower_shares_ = SharesOfLength(neutral.vertices, lower);
  if (upper.size() >= lower.size()) {
    upper_shares_ = MatchedShares(lower_shares_, upper_shares_);
  } else {
    lower_shares_ = MatchedShares(upper_shares_, lower_shares_);
  }
  std::map<int, int> place_of;
  const auto add = [&](const Follower& follower) {
    if (!place_of.emplace(follower.vertex, int(followers_.size())).second) return;
    followers_.push_back(follower);
  };
  add({upper.front(), 0, Side::kBoth, 0, {}});
  add({upper.back(), 0, Side::kBoth, 1, {}});
  for (size_t i = 0; i < upper.size(); ++i) add({upper[i], 0, Side::kUpper, upper_shares_[i], {}});
  for (size_t i = 0; i < lower.size(); ++i) add({lower[i], 0, Side::kLower, lower_shares_[i], {}});
  num_edge_vertices_ = static_cast<int>(followers_.size());

  const geometry::Adjacency neighbours =
      geometry::VertexNeighbours(neutral.triangles, static_cast<int>(neutral.vertices.rows()));
  size_t begin = 0;
  for (int ring = 1; ring <= num_rings; ++ring) {
    const size_t end = followers_.size();
    std::map<int, std::vector<int>> parents;
    for (size_t i = begin; i < end; ++i) {
      for (const int other : neighbours[followers_[i].vertex])
        if (!place_of.contains(other)) parents[other].push_back(static_cast<int>(i));
    }
    for (const auto& [vertex, of] : parents) {
      std::set<Side> sides;
      double share = 0;
      for (const int parent : of) {
        sides.insert(followers_[size_t(parent)].side);
        share += followers_[size_t(parent)].share / double(of.size());
      }
      sides.erase(Side::kBoth);
      add({vertex, ring, sides.size() == 1 ? *sides.begin() : Side::kBoth, share, of});
    }
    begin = end;
  }
}

Eigen::Vector3d Seam::PointAt(const geometry::Points& pose, Side edge, double share) const {
  const std::vector<int>& path = edge == Side::kUpper ? edges_.upper : edges_.lower;
  const std::vector<double>& shares = edge == Side::kUpper ? upper_shares_ : lower_shares_;
  const auto right = std::lower_bound(shares.begin() + 1, shares.end() - 1, share) - shares.begin();
  const double length = shares[size_t(right)] - shares[size_t(right) - 1];
  const double t = length > 0 ? std::clamp((share - shares[size_t(right) - 1]) / length, 0.0, 1.0) : 0.0;
  return ((1 - t) * pose.row(path[size_t(right) - 1]) + t * pose.row(path[size_t(right)])).transpose();
}

void Seam::Follow(const std::vector<Eigen::Vector3d>& moves, geometry::Points& pose) const {
  std::vector<Eigen::Vector3d> whole(followers_.size(), Eigen::Vector3d::Zero());
  for (size_t i = 0; i < followers_.size(); ++i) {
    const Follower& follower = followers_[i];
    if (follower.ring == 0) {
      whole[i] = moves[i];
    } else {
      for (const int parent : follower.parents) whole[i] += whole[size_t(parent)] / double(follower.parents.size());
    }
    const double t = 1 - follower.ring / (num_rings_ + 1.0);
    pose.row(follower.vertex) += (t * t * (3 - 2 * t)) * whole[i].transpose();
  }
}

/// Of unit length: across the seam to its upper side, in the skin.
Eigen::Vector3d Seam::Across(const SeamFrame& frame, const geometry::Points& pose, double share) const {
  constexpr double kStep = 0.02;  // Of the edges' length.
  const auto middle = [&](double at) -> Eigen::Vector3d {
    return PointAt(pose, Side::kUpper, at) + PointAt(pose, Side::kLower, at);
  };
  const Eigen::Vector3d across = frame.out.cross(middle(share + kStep) - middle(share - kStep));
  return across.dot(frame.up) > 0 ? Eigen::Vector3d(across.normalized()) : frame.up;
}

void Seam::Clamp(const SeamFrame& frame, geometry::Points& pose) const {
  constexpr double kCorner = 0.15;  // Share of the edges' length over which it sets in: beyond a corner nothing faces.
  constexpr int kNearRings = 3;
  const geometry::Points met = pose;
  for (const Follower& follower : followers_) {
    if (follower.ring == 0 || follower.ring > kNearRings || follower.side == Side::kBoth) continue;
    const double inside = std::min({1.0, follower.share / kCorner, (1 - follower.share) / kCorner});
    const Eigen::Vector3d up = Across(frame, met, follower.share);
    const double above = up.dot(met.row(follower.vertex).transpose() - PointAt(met, Side::kUpper, follower.share));
    const double lift = follower.side == Side::kUpper ? std::max(0.0, -above) : std::min(0.0, -above);
    pose.row(follower.vertex) += inside * lift * up.transpose();
  }
}

void Seam::Join(const SeamFrame& frame, double upper_share, SeamDepth depth, geometry::Points& pose) const {
  std::vector<Eigen::Vector3d> moves(size_t(num_edge_vertices_), Eigen::Vector3d::Zero());
  for (size_t i = 0; i < moves.size(); ++i) {
    const Follower& follower = followers_[i];
    if (follower.side == Side::kBoth) continue;
    const Eigen::Vector3d upper = PointAt(pose, Side::kUpper, follower.share),
                          lower = PointAt(pose, Side::kLower, follower.share);
    Eigen::Vector3d meeting = upper + upper_share * (lower - upper);
    if (depth == SeamDepth::kFarther)
      meeting += (std::max(frame.out.dot(upper), frame.out.dot(lower)) - frame.out.dot(meeting)) * frame.out;
    moves[i] = meeting - pose.row(follower.vertex).transpose();
  }
  Follow(moves, pose);
  // Between its vertices an edge is straight: the finer one comes to lie on the coarser one.
  const Side finer = edges_.upper.size() >= edges_.lower.size() ? Side::kUpper : Side::kLower;
  const geometry::Points followed = pose;
  for (int i = 0; i < num_edge_vertices_; ++i) {
    const Follower& follower = followers_[size_t(i)];
    if (follower.side == finer)
      pose.row(follower.vertex) =
          PointAt(followed, finer == Side::kUpper ? Side::kLower : Side::kUpper, follower.share).transpose();
  }
}

void Seam::Meet(const SeamFrame& frame, double upper_share, SeamDepth depth, geometry::Points& pose) const {
  Join(frame, upper_share, depth, pose);
  Clamp(frame, pose);
}

std::vector<double> Seam::HeightsOfEdges(const SeamFrame& frame, const geometry::Points& pose) const {
  std::vector<double> heights;
  for (int i = 0; i < num_edge_vertices_; ++i) {
    const double share = followers_[size_t(i)].share;
    heights.push_back(
        Across(frame, pose, share).dot(PointAt(pose, Side::kUpper, share) - PointAt(pose, Side::kLower, share)));
  }
  return heights;
}

void Seam::KeepApart(const SeamFrame& frame, const geometry::Points& rest, double kept_share,
                     geometry::Points& pose) const {
  constexpr int kMostTimes = 8;
  constexpr double kToleranceCm = 0.002;
  const std::vector<double> before = HeightsOfEdges(frame, rest);
  for (int time = 0; time < kMostTimes; ++time) {  // Vertices face points between others, which move too.
    const std::vector<double> now = HeightsOfEdges(frame, pose);
    std::vector<Eigen::Vector3d> moves(now.size(), Eigen::Vector3d::Zero());
    double most = 0;
    for (size_t i = 0; i < moves.size(); ++i) {
      const double excess = (before[i] > 0 ? kept_share * before[i] : before[i]) - now[i];
      if (excess <= 0 || followers_[i].side == Side::kBoth) continue;
      moves[i] = (followers_[i].side == Side::kUpper ? 0.5 : -0.5) * excess * Across(frame, pose, followers_[i].share);
      most = std::max(most, excess);
    }
    if (most <= kToleranceCm) return;
    Follow(moves, pose);
  }
}

std::vector<double> Seam::Heights(const SeamFrame& frame, const geometry::Points& pose) const {
  std::vector<double> heights;
  const std::vector<double> all = HeightsOfEdges(frame, pose);
  for (size_t i = 0; i < all.size(); ++i)
    if (followers_[i].side != Side::kBoth) heights.push_back(all[i]);
  return heights;
}

std::vector<double> Seam::Gaps(const geometry::Points& pose) const {
  std::vector<double> gaps;
  for (const auto& [path, other] : {std::pair(&edges_.upper, &edges_.lower), std::pair(&edges_.lower, &edges_.upper)}) {
    for (size_t i = 1; i + 1 < path->size(); ++i)
      gaps.push_back(DistanceToPath(pose.row((*path)[i]).transpose(), pose, *other));
  }
  return gaps;
}

}  // namespace daumier::rig
