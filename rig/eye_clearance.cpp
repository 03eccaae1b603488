#include "rig/eye_clearance.h"

#include "core/error.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace daumier::rig {
namespace {

constexpr double kReach = 1.2;          // Of the opening's width.
constexpr double kSpareCm = 0.003;      // Kept free between skin and ball.
constexpr double kSurelyFreeCm = 0.08;  // Triangles whose corners are as far outside bend around the ball.
constexpr double kLeastMoveCm2 = 1e-8;  // Squared: skin that moves less stays where it is at rest.
constexpr int kSpreadSweeps = 8;
constexpr double kSetBackCm = 0.05, kBulgeKept = 0.35;

/// Corners, middles of edges and the middle of a triangle, as weights of its corners.
constexpr std::array<std::array<double, 3>, 4> kInner = {
    {{0.5, 0.5, 0}, {0, 0.5, 0.5}, {0.5, 0, 0.5}, {1.0 / 3, 1.0 / 3, 1.0 / 3}}};

/// V: what is connected to the loop of the hole but for the edges.
std::vector<bool> Behind(const geometry::TriangleMesh& neutral, const std::vector<int>& hole, const SeamEdges& edges) {
  const int num_vertices = static_cast<int>(neutral.vertices.rows());
  const geometry::Adjacency neighbours = geometry::VertexNeighbours(neutral.triangles, num_vertices);
  std::vector<bool> is_edge(size_t(num_vertices), false), is_behind = is_edge;
  for (const auto* edge : {&edges.upper, &edges.lower})
    for (const int v : *edge) is_edge[size_t(v)] = true;
  std::vector<int> next;
  const auto add = [&](int v) {
    if (is_edge[size_t(v)] || is_behind[size_t(v)]) return;
    is_behind[size_t(v)] = true;
    next.push_back(v);
  };
  for (const int v : hole) add(v);
  while (!next.empty()) {
    const int v = next.back();
    next.pop_back();
    for (const int other : neighbours[v]) add(other);
  }
  return is_behind;
}

}  // namespace

faces::Eyeball SetBack(const faces::Eyeball& fitted) {
  faces::Eyeball shipped = fitted;
  shipped.radii.setConstant(fitted.radii.x());
  shipped.bulge *= kBulgeKept;
  shipped.centre.z() -= kSetBackCm;
  return shipped;
}

double EyeClearance(const faces::Eyeball& eyeball, const Eigen::Vector3d& gaze, const Eigen::Vector3d& point) {
  const Eigen::Vector3d from_centre = point - eyeball.centre;
  const double distance = from_centre.norm();
  if (distance == 0) return -eyeball.radii.minCoeff();
  Eigen::Vector3d ray = from_centre / distance;
  if (gaze.z() < 1) ray = Eigen::Quaterniond::FromTwoVectors(gaze, Eigen::Vector3d::UnitZ()) * ray;
  double surface = 1 / ray.cwiseQuotient(eyeball.radii).norm();
  if (ray.z() > 0 && eyeball.bulge > 0) {
    const double ball = surface, aside = std::hypot(ray.x(), ray.y());
    for (int step = 0; step < 2; ++step) {
      const double share = std::max(0.0, 1 - std::pow(surface * aside / eyeball.iris_radius, 2));
      surface = ball + eyeball.bulge * share * share * ray.z();
    }
  }
  return distance - surface;
}

Eigen::Vector3d GazeOf(double left_degrees, double down_degrees) {
  const double left = left_degrees * std::numbers::pi / 180, down = down_degrees * std::numbers::pi / 180;
  return {std::sin(left) * std::cos(down), -std::sin(down), std::cos(left) * std::cos(down)};
}

EyeSkin::EyeSkin(const geometry::TriangleMesh& neutral, const std::vector<int>& lids, const SeamEdges& edges) {
  DAUMIER_CHECK(!lids.empty(), "an eye without lids");
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double least = neutral.vertices(lids[0], 0), greatest = least;
  for (const int v : lids) {
    middle += neutral.vertices.row(v).transpose() / double(lids.size());
    least = std::min(least, neutral.vertices(v, 0));
    greatest = std::max(greatest, neutral.vertices(v, 0));
  }
  const std::vector<bool> is_behind = Behind(neutral, lids, edges);
  std::vector<int> place_of(size_t(neutral.vertices.rows()), -1);
  for (int v = 0; v < neutral.vertices.rows(); ++v) {
    if (is_behind[size_t(v)] || (neutral.vertices.row(v).transpose() - middle).norm() > kReach * (greatest - least))
      continue;
    place_of[size_t(v)] = static_cast<int>(vertices_.size());
    vertices_.push_back(v);
  }
  std::vector<Eigen::Vector3i> inside;
  for (const auto& t : neutral.triangles.rowwise()) {
    const Eigen::Vector3i places(place_of[size_t(t[0])], place_of[size_t(t[1])], place_of[size_t(t[2])]);
    if (places.minCoeff() >= 0) triangles_.push_back(places);
  }
  geometry::Triangles triangles(Eigen::Index(triangles_.size()), 3);
  for (size_t t = 0; t < triangles_.size(); ++t) triangles.row(Eigen::Index(t)) = triangles_[t].transpose();
  neighbours_ = geometry::VertexNeighbours(triangles, static_cast<int>(vertices_.size()));
}

double EyeSkin::GreatestMove(const Eigen::VectorXf& offset) const {
  float greatest = 0;
  for (const int v : vertices_) greatest = std::max(greatest, offset.segment<3>(3 * v).norm());
  return double(greatest);
}

double EyeSkin::LeastClearance(const faces::Eyeball& eyeball, const Eigen::Vector3d& gaze,
                               const geometry::Points& pose) const {
  double least = std::numeric_limits<double>::infinity();
  const auto at = [&](int place) -> Eigen::Vector3d { return pose.row(vertices_[size_t(place)]).transpose(); };
  for (int place = 0; place < static_cast<int>(vertices_.size()); ++place)
    least = std::min(least, EyeClearance(eyeball, gaze, at(place)));
  for (const Eigen::Vector3i& t : triangles_) {
    const Eigen::Vector3d a = at(t[0]), b = at(t[1]), c = at(t[2]);
    for (const auto& w : kInner) least = std::min(least, EyeClearance(eyeball, gaze, w[0] * a + w[1] * b + w[2] * c));
  }
  return least;
}

void EyeSkin::KeepOutside(const faces::Eyeball& eyeball, const GazeTurn& turn, const geometry::Points& rest,
                          geometry::Points& pose) const {
  constexpr std::array<double, 5> kTimes = {0.15, 0.3, 0.5, 0.75, 1};
  const size_t num_vertices = vertices_.size();
  const double sphere = eyeball.radii.maxCoeff() + eyeball.bulge;
  std::vector<double> needed(num_vertices, 0), clearance(num_vertices);
  std::vector<bool> moves(num_vertices);
  for (size_t i = 0; i < num_vertices; ++i)
    moves[i] = (pose.row(vertices_[i]) - rest.row(vertices_[i])).squaredNorm() > kLeastMoveCm2;
  geometry::Points points(Eigen::Index(num_vertices), 3);
  double most = 0;
  for (const double time : kTimes) {
    const Eigen::Vector3d gaze = GazeOf(time * turn.left_degrees, time * turn.down_degrees);
    for (size_t i = 0; i < num_vertices; ++i) {
      const Eigen::Vector3d point = ((1 - time) * rest.row(vertices_[i]) + time * pose.row(vertices_[i])).transpose();
      points.row(Eigen::Index(i)) = point.transpose();
      clearance[i] = (point - eyeball.centre).norm() - sphere;  // Not more than the true one.
      if (clearance[i] < kSurelyFreeCm) clearance[i] = EyeClearance(eyeball, gaze, point);
      if (moves[i]) needed[i] = std::max(needed[i], (kSpareCm - clearance[i]) / time);
      most = std::max(most, needed[i]);
    }
    for (const Eigen::Vector3i& t : triangles_) {
      const auto [a, b, c] = std::array{size_t(t[0]), size_t(t[1]), size_t(t[2])};
      if (!(moves[a] || moves[b] || moves[c]) || std::min({clearance[a], clearance[b], clearance[c]}) > kSurelyFreeCm)
        continue;
      for (const auto& w : kInner) {
        const Eigen::Vector3d p =
            (w[0] * points.row(t[0]) + w[1] * points.row(t[1]) + w[2] * points.row(t[2])).transpose();
        const double push = (kSpareCm - EyeClearance(eyeball, gaze, p)) / time;
        if (push <= 0) continue;
        most = std::max(most, push);
        for (const size_t corner : {a, b, c}) needed[corner] = std::max(needed[corner], push);
      }
    }
  }
  if (most == 0) return;
  // Wider and never less: so the skin stays smooth.
  std::vector<double> push = needed, next = needed;
  for (int sweep = 0; sweep < kSpreadSweeps; ++sweep) {
    for (size_t i = 0; i < push.size(); ++i) {
      double sum = 0;
      for (const int other : neighbours_[int(i)]) sum += push[size_t(other)];
      const auto count = double(neighbours_[int(i)].size());
      next[i] = std::max(needed[i], count > 0 ? sum / count : 0.0);
    }
    push.swap(next);
  }
  for (size_t i = 0; i < push.size(); ++i) {
    if (push[i] <= 0) continue;
    const Eigen::Vector3d out = (pose.row(vertices_[i]).transpose() - eyeball.centre).normalized();
    pose.row(vertices_[i]) += push[i] * out.transpose();
  }
}

}  // namespace daumier::rig
