#include "rig/eye_clearance.h"

#include "core/error.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace daumier::rig {
namespace {

constexpr double kReach = 1.2;         // Of the opening's width.
constexpr double kSpareCm = 0.003;     // Kept free between skin and ball.
constexpr double kSurelyFreeCm = 0.2;  // Triangles whose corners are as far outside are not looked into.
constexpr int kSpreadSweeps = 8;

/// Corners, middles of edges and the middle of a triangle, as weights of its corners.
constexpr std::array<std::array<double, 3>, 4> kInner = {
    {{0.5, 0.5, 0}, {0, 0.5, 0.5}, {0.5, 0, 0.5}, {1.0 / 3, 1.0 / 3, 1.0 / 3}}};

}  // namespace

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

EyeSkin::EyeSkin(const geometry::TriangleMesh& neutral, const std::vector<int>& lids) {
  DAUMIER_CHECK(!lids.empty(), "an eye without lids");
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double least = neutral.vertices(lids[0], 0), greatest = least;
  for (const int v : lids) {
    middle += neutral.vertices.row(v).transpose() / double(lids.size());
    least = std::min(least, neutral.vertices(v, 0));
    greatest = std::max(greatest, neutral.vertices(v, 0));
  }
  std::vector<int> place_of(size_t(neutral.vertices.rows()), -1);
  for (int v = 0; v < neutral.vertices.rows(); ++v) {
    if ((neutral.vertices.row(v).transpose() - middle).norm() > kReach * (greatest - least)) continue;
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
  std::vector<double> needed(vertices_.size(), 0);
  geometry::Points points(Eigen::Index(vertices_.size()), 3);
  std::vector<double> clearance(vertices_.size());
  double most = 0;
  for (const double time : kTimes) {
    const Eigen::Vector3d gaze = GazeOf(time * turn.left_degrees, time * turn.down_degrees);
    for (size_t i = 0; i < vertices_.size(); ++i) {
      points.row(Eigen::Index(i)) = (1 - time) * rest.row(vertices_[i]) + time * pose.row(vertices_[i]);
      clearance[i] = EyeClearance(eyeball, gaze, points.row(Eigen::Index(i)).transpose());
      needed[i] = std::max(needed[i], (kSpareCm - clearance[i]) / time);
      most = std::max(most, needed[i]);
    }
    for (const Eigen::Vector3i& t : triangles_) {
      if (std::min({clearance[size_t(t[0])], clearance[size_t(t[1])], clearance[size_t(t[2])]}) > kSurelyFreeCm)
        continue;
      for (const auto& w : kInner) {
        const Eigen::Vector3d p =
            (w[0] * points.row(t[0]) + w[1] * points.row(t[1]) + w[2] * points.row(t[2])).transpose();
        const double push = (kSpareCm - EyeClearance(eyeball, gaze, p)) / time;
        if (push <= 0) continue;
        most = std::max(most, push);
        for (const int corner : t) needed[size_t(corner)] = std::max(needed[size_t(corner)], push);
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
