#include "fitting/opening_moves.h"

#include "core/error.h"
#include "geometry/topology.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <queue>

namespace daumier::fitting {
namespace {

using geometry::Vector3;

/// The places of the lower line lie between its vertices, so that a move of these is not exact at once.
constexpr int kReachRounds = 6;
/// Lips that rest on each other are so far apart at their borders, which are rounded.
constexpr double kClosedLipsCm = 0.05;

/// Length along edges to the nearest vertex of a line, and which one it is.
struct Reached {
  double length;
  int leader;
};

/// By Dijkstra's algorithm up to a length.
std::map<int, Reached> ReachAlongEdges(const geometry::Points& points, const geometry::Adjacency& neighbours,
                                       const std::vector<int>& line, double reach) {
  using Entry = std::tuple<double, int, int>;  // Length, vertex, leader.
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (size_t i = 0; i < line.size(); ++i) queue.emplace(0.0, line[i], int(i));
  std::map<int, Reached> reached;
  while (!queue.empty()) {
    const auto [length, vertex, leader] = queue.top();
    queue.pop();
    if (!reached.emplace(vertex, Reached{length, leader}).second) continue;
    for (const int next : neighbours[vertex]) {
      const double further = length + (points.row(next) - points.row(vertex)).norm();
      if (further < reach && !reached.contains(next)) queue.emplace(further, next, leader);
    }
  }
  return reached;
}

Vector3 PlaceOf(const faces::PolylinePlace& place, const geometry::Points& vertices) {
  return (1 - place.share) * vertices.row(place.from) + place.share * vertices.row(place.to);
}

/// Moves of the lower line from those at places on it; vertices between two places get the mean of theirs.
geometry::Points MovesOfLower(const OpeningPairs& opening, const geometry::Points& moves_of_pairs) {
  const Eigen::Index count(opening.lower.size());
  std::map<int, Eigen::Index> position;
  for (Eigen::Index i = 0; i < count; ++i) position[opening.lower[size_t(i)]] = i;
  geometry::Points sums = geometry::Points::Zero(count, 3);
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(count);
  for (size_t k = 0; k < opening.pairs.size(); ++k) {
    const faces::PolylinePlace& place = opening.pairs[k].lower;
    for (const auto& [vertex, weight] : {std::pair(place.from, 1 - place.share), std::pair(place.to, place.share)}) {
      sums.row(position.at(vertex)) += weight * moves_of_pairs.row(Eigen::Index(k));
      weights[position.at(vertex)] += weight;
    }
  }
  for (Eigen::Index i = 0; i < count; ++i) {
    if (weights[i] > 1e-6) sums.row(i) /= weights[i];
  }
  for (Eigen::Index i = 1; i + 1 < count; ++i) {  // A vertex that no pair is near.
    if (weights[i] <= 1e-6) sums.row(i) = (sums.row(i - 1) + sums.row(i + 1)) / 2;
  }
  return sums;
}

}  // namespace

double LeastGap(const GapGoal& goal, double share) {
  return goal.least_middle_cm * 4 * share * (1 - share);
}

Eigen::VectorXd GapsOf(const OpeningPairs& opening, const geometry::Points& vertices) {
  Eigen::VectorXd gaps(Eigen::Index(opening.pairs.size()));
  for (Eigen::Index k = 0; k < gaps.size(); ++k) {
    const GapPair& pair = opening.pairs[size_t(k)];
    gaps[k] = vertices(pair.upper, 1) - PlaceOf(pair.lower, vertices).y();
  }
  return gaps;
}

OpeningMover::OpeningMover(const faces::FaceTemplate& face_template, std::vector<OpeningPairs> openings,
                           double lip_reach_cm, double lid_reach_cm)
    : openings_(std::move(openings)) {
  DAUMIER_CHECK(lip_reach_cm > 0 && lid_reach_cm > 0, "skin follows lips over {} cm and lids over {} cm", lip_reach_cm,
                lid_reach_cm);
  const geometry::Adjacency neighbours =
      geometry::VertexNeighbours(face_template.triangles, face_template.num_vertices());
  for (const OpeningPairs& opening : openings_) {
    const double reach = opening.opening == Opening::kMouth ? lip_reach_cm : lid_reach_cm;
    const auto upper = ReachAlongEdges(face_template.neutral, neighbours, opening.upper, reach),
               lower = ReachAlongEdges(face_template.neutral, neighbours, opening.lower, reach);
    Lines lines;
    // Beyond the corners skin belongs to the nearer line.
    const auto collect = [&](const auto& own, const auto& other, std::vector<Follower>& followers) {
      for (const auto& [vertex, at] : own) {
        const auto rival = other.find(vertex);
        if (rival != other.end() && rival->second.length < at.length) continue;
        const double share = at.length / reach;
        followers.push_back({vertex, at.leader, std::pow(1 - share * share, 2)});
      }
    };
    collect(upper, lower, lines.upper);
    collect(lower, upper, lines.lower);
    followers_.push_back(std::move(lines));
  }
}

void OpeningMover::Reach(const GapGoal& goal, size_t index, geometry::Points& vertices) const {
  const OpeningPairs& opening = openings_[index];
  const double upper_part = opening.opening == Opening::kMouth ? 0.5 : 1.0;
  for (int round = 0; round < kReachRounds; ++round) {
    const Eigen::VectorXd gaps = GapsOf(opening, vertices);
    geometry::Points moves = geometry::Points::Zero(gaps.size(), 3);  // Of the upper line against the lower.
    for (Eigen::Index k = 0; k < gaps.size(); ++k) {
      const GapPair& pair = opening.pairs[size_t(k)];
      if (goal.closed && opening.opening == Opening::kMouth) {
        moves(k, 1) = std::clamp(gaps[k], 0.0, kClosedLipsCm) - gaps[k];
      } else if (goal.closed) {
        moves.row(k).tail<2>() = (PlaceOf(pair.lower, vertices).transpose() - vertices.row(pair.upper)).tail<2>();
      } else {
        moves(k, 1) = std::max(0.0, LeastGap(goal, pair.share) - gaps[k]);
      }
    }
    if (moves.isZero(0)) return;
    const geometry::Points upper = upper_part * moves, lower = MovesOfLower(opening, -(1 - upper_part) * moves);
    for (const Follower& follower : followers_[index].upper)
      vertices.row(follower.vertex) += follower.share * upper.row(follower.leader);
    for (const Follower& follower : followers_[index].lower)
      vertices.row(follower.vertex) += follower.share * lower.row(follower.leader);
  }
}

}  // namespace daumier::fitting
