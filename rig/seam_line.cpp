#include "rig/seam_line.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace daumier::rig {
namespace {

constexpr int kNumSteps = 48;          // Along a seam.
constexpr int kNumOffsets = 15;        // Of a groove, on both sides and on the line.
constexpr double kDeepestPlace = 0.2;  // Of places in front of or behind a line, in widths.
constexpr double kSpread = 0.012;      // Of a place's concavity, in widths.
constexpr double kLeavingCost = 0.15;  // At the farthest offset.
constexpr double kTurningCost = 0.02;  // Of one offset a step, squared.

/// Where the seam of one edge is at each step of the other's way: points at equal shares of its length.
geometry::Points PointsAlong(const std::vector<int>& path, const geometry::Points& points, int num_points) {
  std::vector<double> ways = {0};
  for (size_t i = 1; i < path.size(); ++i)
    ways.push_back(ways.back() + (points.row(path[i]) - points.row(path[i - 1])).norm());
  geometry::Points along(num_points, 3);
  size_t i = 1;
  for (int s = 0; s < num_points; ++s) {
    const double way = ways.back() * s / (num_points - 1);
    while (i + 1 < path.size() && ways[i] < way) ++i;
    const double step = ways[i] - ways[i - 1], share = step > 0 ? std::clamp((way - ways[i - 1]) / step, 0.0, 1.0) : 0;
    along.row(s) = (1 - share) * points.row(path[i - 1]) + share * points.row(path[i]);
  }
  return along;
}

double AtStep(const Eigen::VectorXd& values, double along, double width) {
  const double step = std::clamp(along / width, 0.0, 1.0) * double(values.size() - 1);
  const Eigen::Index before = std::min(Eigen::Index(step), values.size() - 2);
  const double share = step - double(before);
  return (1 - share) * values[before] + share * values[before + 1];
}

/// How far the neighbours of a place lie in front of it, over their distance: positive in a groove.
double Concavity(const HeadSurface& head, int place) {
  double sum = 0;
  for (const int q : head.neighbours[place]) {
    const Eigen::RowVector3d edge = head.mesh.vertices.row(q) - head.mesh.vertices.row(place);
    const double length = edge.norm();
    if (length > 0) sum += edge.dot(head.normals.row(place)) / length;
  }
  return sum / double(std::max<size_t>(1, head.neighbours[place].size()));
}

/// Steps x offsets: the concavity around places near a line.
Eigen::MatrixXd ConcavityAround(const HeadSurface& head, const SeamLine& line) {
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(kNumSteps, kNumOffsets), weights = sums;
  const double spread = kSpread * line.width, reach = (kGrooveReach + 3 * kSpread) * line.width;
  for (int p = 0; p < head.num_places(); ++p) {
    const geometry::Vector3 at = line.Coordinates(head.mesh.vertices.row(p));
    const double over = at.y() - line.HeightAt(at.x());
    if (at.x() < -3 * spread || at.x() > line.width + 3 * spread || std::abs(over) > reach ||
        std::abs(at.z() - line.DepthAt(at.x())) > kDeepestPlace * line.width ||
        head.normals.row(p).dot(line.frame.out.transpose()) < 0)
      continue;
    const double concavity = Concavity(head, p);
    for (int s = 0; s < kNumSteps; ++s) {
      const double away = at.x() - line.width * s / (kNumSteps - 1);
      if (std::abs(away) > 3 * spread) continue;
      for (int o = 0; o < kNumOffsets; ++o) {
        const double offset = kGrooveReach * line.width * (2.0 * o / (kNumOffsets - 1) - 1);
        const double weight = std::exp(-0.5 * (away * away + (over - offset) * (over - offset)) / (spread * spread));
        sums(s, o) += weight * concavity;
        weights(s, o) += weight;
      }
    }
  }
  return (weights.array() > 1e-6).select(sums.array() / weights.array().max(1e-6), 0.0);
}

}  // namespace

geometry::Vector3 SeamLine::Coordinates(const geometry::Vector3& point) const {
  const geometry::Vector3 from = point - origin;
  return {from.dot(frame.along), from.dot(frame.up), from.dot(frame.out)};
}

double SeamLine::HeightAt(double along) const {
  return AtStep(heights, along, width);
}

double SeamLine::DepthAt(double along) const {
  return AtStep(depths, along, width);
}

SeamLine MiddleOfSlit(const SeamEdges& edges, const geometry::Points& registered) {
  SeamLine line;
  line.frame = FrameOfSeam(edges, registered, geometry::Vector3::UnitZ());
  line.origin = registered.row(edges.upper.front()).transpose();
  line.width = (registered.row(edges.upper.back()) - registered.row(edges.upper.front())).norm();
  const geometry::Points middle =
      0.5 * (PointsAlong(edges.upper, registered, 4 * kNumSteps) + PointsAlong(edges.lower, registered, 4 * kNumSteps));
  line.heights.resize(kNumSteps);
  line.depths.resize(kNumSteps);
  Eigen::Index i = 0;
  for (int s = 0; s < kNumSteps; ++s) {  // Equal steps along the width, from equal steps along the edges.
    const double along = line.width * s / (kNumSteps - 1);
    while (i + 2 < middle.rows() && line.Coordinates(middle.row(i + 1)).x() < along) ++i;
    const geometry::Vector3 before = line.Coordinates(middle.row(i)), after = line.Coordinates(middle.row(i + 1));
    const double step = after.x() - before.x();
    const double share = step > 0 ? std::clamp((along - before.x()) / step, 0.0, 1.0) : 0;
    line.heights[s] = (1 - share) * before.y() + share * after.y();
    line.depths[s] = (1 - share) * before.z() + share * after.z();
  }
  return line;
}

void DrawToGroove(const HeadSurface& head, SeamLine& line) {
  const Eigen::MatrixXd concavity = ConcavityAround(head, line);
  const auto offset_of = [](int o) { return 2.0 * o / (kNumOffsets - 1) - 1; };
  Eigen::MatrixXd gains = Eigen::MatrixXd::Constant(kNumSteps, kNumOffsets, -std::numeric_limits<double>::infinity());
  Eigen::MatrixXi from = Eigen::MatrixXi::Zero(kNumSteps, kNumOffsets);
  for (int s = 0; s < kNumSteps; ++s) {
    for (int o = 0; o < kNumOffsets; ++o) {
      const double gain = concavity(s, o) - kLeavingCost * offset_of(o) * offset_of(o);
      for (int before = std::max(0, o - 2); before <= std::min(kNumOffsets - 1, o + 2); ++before) {
        const double sum = gain + (s > 0 ? gains(s - 1, before) - kTurningCost * (o - before) * (o - before) : 0);
        if (sum <= gains(s, o)) continue;
        gains(s, o) = sum;
        from(s, o) = before;
      }
    }
  }
  int offset = 0;
  gains.row(kNumSteps - 1).maxCoeff(&offset);
  Eigen::VectorXd moves(kNumSteps);
  for (int s = kNumSteps - 1; s >= 0; --s) {
    moves[s] = kGrooveReach * line.width * offset_of(offset);
    offset = from(s, offset);
  }
  for (int s = 0; s < kNumSteps; ++s) {
    const int low = std::max(0, s - 2), high = std::min(kNumSteps - 1, s + 2);
    line.heights[s] += moves.segment(low, high - low + 1).mean();
  }
}

}  // namespace daumier::rig
