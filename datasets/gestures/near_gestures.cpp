#include "datasets/gestures/near_gestures.h"

#include "datasets/gestures/gesture_shapes.h"
#include "datasets/gestures/path_pen.h"

#include <cmath>
#include <numbers>

namespace daumier::datasets {
namespace {

using Eigen::Vector2d;
using std::numbers::pi;

constexpr double kDegrees = pi / 180;

/// The line moved behind another one, turned so that it begins in that direction from the other one's last.
Polyline Continued(const Polyline& first, const Polyline& second, double turn) {
  const auto heading = [](const Vector2d& a, const Vector2d& b) { return std::atan2((b - a).y(), (b - a).x()); };
  const double leaves = heading(first[first.size() - 2], first.back()), begins = heading(second[0], second[1]);
  const Polyline turned = Turned(second, leaves + turn - begins);
  Polyline line = first;
  for (const Vector2d& point : turned) line.push_back(first.back() + point - turned.front());
  return line;
}

double LevelOrUpright(Rng& rng) {
  const double quarter = double(rng.Below(4)) * 90;
  return (quarter + rng.Uniform(-6, 6)) * kDegrees;
}

}  // namespace

Polyline ManyLoops(Rng& rng) {
  const Polyline loops = DrawLoops(4 + int(rng.Below(6)), rng);
  return Aimed(loops, rng.Uniform(-pi, pi));
}

Polyline LevelLoops(Rng& rng) {
  const Polyline loops = DrawLoops(1 + int(rng.Below(3)), rng);
  return Aimed(loops, LevelOrUpright(rng));
}

Polyline MixedLoops(Rng& rng) {
  PathPen pen;
  const double sense = EitherSign(rng);
  if (Happens(0.4, rng)) {  // A ring with long ends that cross below it, a bow, a fish.
    const double angle = sense * rng.Uniform(1.1, 1.45) * pi, way = rng.Uniform(0.8, 3);
    const Polyline ring = pen.Forward(way).Arc(angle, 1).Forward(way * rng.Uniform(0.7, 1.4)).points();
    return Turned(ring, rng.Uniform(-pi, pi));
  }
  const int num_loops = 2 + int(rng.Below(3));
  double side = sense;
  for (int i = 0; i < num_loops; ++i) {
    pen.Forward(LogUniform(0.6, 3, rng));
    pen.Arc(side * 2 * pi, LogUniform(0.5, 1.2, rng));
    side = i + 2 == num_loops && side == sense ? -side : side * EitherSign(rng);
  }
  pen.Forward(rng.Uniform(0.5, 2));
  return Aimed(pen.points(), LevelOrUpright(rng));
}

Polyline TurnedArrow(Rng& rng) {
  const double side = EitherSign(rng), angle = Happens(0.7, rng) ? rng.Uniform(62, 118) : rng.Uniform(46, 134);
  return Turned(DrawArrow(rng), side * angle * kDegrees);
}

Polyline DoubleArrow(Rng& rng) {
  const auto head = [&] {
    const double length = LogUniform(0.12, 0.42, rng), side = EitherSign(rng),
                 angle = side * rng.Uniform(18, 66) * kDegrees;
    const Vector2d first = length * Vector2d(-std::cos(angle), -std::sin(angle)), second(first.x(), -first.y());
    return Happens(0.5, rng) ? Polyline{{0, 0}, first} : Polyline{{0, 0}, first, {0, 0}, second};
  };
  Polyline corners;
  for (const Vector2d& point : Reversed(head())) corners.emplace_back(-point);
  corners.back() = {0, 0};
  for (const Vector2d& point : head()) corners.push_back(point + Vector2d(1, 0));
  const double tilt = (Happens(0.7, rng) ? rng.Uniform(-30, 30) : rng.Uniform(-180, 180)) * kDegrees;
  return Turned(Resampled(corners, 300), tilt);
}

Polyline BrokenArrow(Rng& rng) {
  const double side = EitherSign(rng);
  PathPen pen(rng.Uniform(-pi, pi));
  pen.Forward(rng.Uniform(0.4, 1.2));
  const bool has_corner = Happens(0.5, rng);
  if (!has_corner) {
    const double angle = rng.Uniform(1.4, 3.2);
    pen.Arc(side * angle, rng.Uniform(0.2, 0.6));
  }
  const Polyline arrow = DrawArrow(rng);
  const bool begins_at_shaft = arrow.front().norm() < 0.05;
  return Continued(pen.points(), begins_at_shaft ? arrow : Reversed(arrow),
                   has_corner ? side * rng.Uniform(1.1, 2.2) : 0);
}

Polyline TailedRegion(Rng& rng) {
  const Polyline region = DrawGestureShape(Gesture::kRegion, rng);
  PathPen tail;
  const double length = LengthOf(region) * rng.Uniform(0.28, 0.8);
  if (Happens(0.5, rng))
    tail.Forward(length);
  else
    tail.Arc(Signed(0.4, 2, rng), length);
  // Outwards: the tail of a lasso, a balloon, a key.
  const Vector2d outwards = region.back() - BoxOf(region).center(), leaves = region.back() - region[region.size() - 2];
  const double to_outside = std::atan2(leaves.x() * outwards.y() - leaves.y() * outwards.x(), leaves.dot(outwards));
  const Polyline line = Continued(region, tail.points(), to_outside + Deviate(0.5, rng));
  return Happens(0.5, rng) ? Reversed(line) : line;
}

}  // namespace daumier::datasets
