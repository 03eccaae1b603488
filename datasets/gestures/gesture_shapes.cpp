#include "datasets/gestures/gesture_shapes.h"

#include "core/error.h"
#include "datasets/gestures/path_pen.h"

#include <array>
#include <cmath>
#include <numbers>

namespace daumier::datasets {
namespace {

using Eigen::Vector2d;
using std::numbers::pi;

constexpr double kDegree = pi / 180;

Polyline LineShape(Rng& rng) {
  Polyline line = DrawShaft(rng);
  if (Happens(0.2, rng)) {
    const double amplitude = rng.Uniform(0, 0.025), waves = rng.Uniform(1, 3);
    line = Waved(line, amplitude, waves, rng.Uniform());
  }
  return Turned(line, rng.Uniform(-pi, pi));
}

/// A closed line around the origin by its radius, a share of which is left out or drawn twice.
Polyline BlobShape(Rng& rng) {
  std::array<double, 4> amplitudes, phases;
  const double wobble = rng.Uniform(0, 0.3);
  for (size_t k = 0; k < amplitudes.size(); ++k) {
    amplitudes[k] = wobble * rng.Normal() / double(k + 2);
    phases[k] = rng.Uniform(-pi, pi);
  }
  const double drift = Deviate(0.06, rng), begin = rng.Uniform(-pi, pi);
  const double kind = rng.Uniform(), most = kind < 0.9 ? 0.14 : 0.25;
  const double angle = 2 * pi * (1 + (kind < 0.5 ? rng.Uniform(-0.1, 0) : rng.Uniform(0, most)));
  Polyline line;
  constexpr int kCount = 300;
  for (int i = 0; i < kCount; ++i) {
    const double share = double(i) / (kCount - 1), at = begin + angle * share;
    double radius = 1 + drift * (share - 0.5);
    for (size_t k = 0; k < amplitudes.size(); ++k) radius += amplitudes[k] * std::cos(double(k + 2) * at + phases[k]);
    radius = std::max(radius, 0.25);
    line.emplace_back(radius * std::cos(at), radius * std::sin(at));
  }
  return Scaled(line, 1, LogUniform(0.3, 1, rng));
}

/// Three to seven corners, their sides straight or bent.
Polyline PolygonShape(Rng& rng) {
  const int num_corners = 3 + static_cast<int>(rng.Below(5));
  const double jitter = rng.Uniform(0, 0.2), bend = Happens(0.5, rng) ? rng.Uniform(-0.5, 0.5) : 0;
  Polyline corners;
  for (int i = 0; i < num_corners; ++i) {
    const double angle = 2 * pi * (i + jitter * rng.Normal()) / num_corners;
    const double radius = 1 + jitter * rng.Normal();
    corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  const Vector2d first = corners.front();
  corners.emplace_back(first + 0.05 * Vector2d{rng.Normal(), rng.Normal()});
  Polyline line;
  for (size_t i = 0; i + 1 < corners.size(); ++i) {
    const Vector2d from = corners[i], way = corners[i + 1] - from, side(-way.y(), way.x());
    for (int k = 0; k < 40; ++k) {
      const double t = k / 40.0;
      line.push_back(from + t * way + bend * t * (1 - t) * side);
    }
  }
  line.push_back(corners.back());
  const bool is_short = Happens(0.4, rng);
  line = is_short ? Part(line, 0, 1 - rng.Uniform(0, 0.08), 300) : line;
  // Begun in the middle of a side: the ends meet there.
  if (!is_short && Happens(0.3, rng)) {
    const double cut = rng.Uniform(0.02, 0.98);
    line = Joined(Part(line, cut, 1, 200), Part(line, 0, cut, 200));
  }
  return Scaled(line, 1, LogUniform(0.35, 1, rng));
}

/// A bean, a crescent or a drop: an arc and a flatter way back.
Polyline CrescentShape(Rng& rng) {
  const double half = rng.Uniform(0.5, 1.2) * pi / 2, depth = rng.Uniform(-0.45, 0.9);
  Polyline line;
  for (int i = 0; i <= 100; ++i) {
    const double t = 1 - 2 * i / 100.0;
    line.emplace_back(std::sin(half * t) / std::sin(std::min(half, pi / 2)), -(std::cos(half * t) - std::cos(half)));
  }
  const Vector2d from = line.back(), to = line.front();
  for (int i = 1; i <= 100; ++i) {
    const double t = i / 100.0;
    line.push_back(from + t * (to - from) + Vector2d(0, depth * std::sin(pi * t) * 0.8));
  }
  return Part(line, 0, 1 - rng.Uniform(0, 0.07), 300);
}

Polyline RegionShape(Rng& rng) {
  const double kind = rng.Uniform();
  Polyline line = kind < 0.55 ? BlobShape(rng) : kind < 0.85 ? PolygonShape(rng) : CrescentShape(rng);
  line = Turned(line, rng.Uniform(-pi, pi));
  if (Happens(0.3, rng)) {  // The ends overshoot: they cross near where they meet.
    const Vector2d in = (line[0] - line[4]).normalized(), out = (line.back() - line[line.size() - 5]).normalized();
    const double length = LengthOf(line);
    line.insert(line.begin(), line.front() + rng.Uniform(0, 0.05) * length * in);
    line.push_back(line.back() + rng.Uniform(0, 0.05) * length * out);
  }
  return Scaled(line, EitherSign(rng), 1);
}

/// Where the pen is at the tip again: near it.
Vector2d NearTip(const Vector2d& tip, Rng& rng) {
  return tip + 0.015 * Vector2d{Deviate(1, rng), Deviate(1, rng)};
}

/// The end of a barb from the tip of a shaft with that heading. side: 1 or -1.
Vector2d BarbEnd(const Vector2d& tip, double heading, double side, double length, Rng& rng) {
  const double angle = heading + pi - side * rng.Uniform(16, 66) * kDegree;
  return tip + length * Vector2d(std::cos(angle), std::sin(angle));
}

/// Straight or a little bent from where the pen is.
void DrawBarb(PathPen& pen, const Vector2d& to, Rng& rng) {
  const Vector2d from = pen.at(), way = to - from, side(-way.y(), way.x());
  const double bend = Deviate(0.12, rng);
  for (int i = 1; i <= 8; ++i) {
    const double t = i / 8.0;
    pen.To(from + t * way + bend * 4 * t * (1 - t) * side);
  }
}

Polyline ArrowAlongX(Rng& rng) {
  PathPen pen;
  for (const Vector2d& point : DrawShaft(rng)) pen.To(point);
  const Vector2d tip = pen.at();
  const double kind = rng.Uniform();
  // One long barb would be a V, two are none.
  const double longest = kind < 0.3 ? 0.42 : 0.6;
  const double heading = pen.heading(), side = EitherSign(rng), length = LogUniform(0.11, longest, rng);
  const Vector2d first = BarbEnd(tip, heading, side, length, rng);
  const Vector2d second = BarbEnd(tip, heading, -side, std::min(longest, length * LogUniform(0.6, 1.6, rng)), rng);
  if (kind < 0.3) {
    DrawBarb(pen, first, rng);
  } else if (kind < 0.7) {
    DrawBarb(pen, first, rng);
    DrawBarb(pen, NearTip(tip, rng), rng);
    DrawBarb(pen, second, rng);
  } else if (kind < 0.82) {
    DrawBarb(pen, first, rng);
    DrawBarb(pen, second, rng);
    if (Happens(0.6, rng)) DrawBarb(pen, NearTip(tip, rng), rng);
  } else if (kind < 0.9) {  // A small round hook.
    const double angle = rng.Uniform(1.9, 3.0), radius = rng.Uniform(0.04, 0.1);
    pen.Arc(side * angle, radius).Forward(rng.Uniform(0.03, 0.2));
  } else {  // The head first: a barb, the tip, the other barb, the tip, the shaft.
    const Polyline head = Joined(Resampled({first, tip}, 40), Resampled({NearTip(tip, rng), second}, 40));
    return Joined(Joined(head, Resampled({second, NearTip(tip, rng)}, 40)), Reversed(pen.points()));
  }
  return pen.points();
}

Polyline ArrowShape(bool points_left, Rng& rng) {
  const double tilt = rng.Uniform(-kShaftTilt, kShaftTilt) * kDegree;
  const Polyline arrow = Turned(DrawArrow(rng), tilt);
  return points_left ? Scaled(arrow, -1, 1) : arrow;
}

/// A trochoid: the loops of a hand that moves on while it circles.
Polyline RoundLoops(int num_loops, Rng& rng) {
  const double ratio = LogUniform(1.7, 3.6, rng), unevenness = rng.Uniform(0, 0.35);
  std::vector<double> radii(size_t(num_loops) + 1);
  for (double& radius : radii) radius = ratio * std::clamp(1 + Deviate(unevenness, rng), 0.7, 1.6);
  Polyline line;
  const int per_loop = 120;
  double x = 0;
  for (int i = 0; i <= per_loop * num_loops; ++i) {
    const double share = double(i) / per_loop, t = pi + 2 * pi * share;
    const size_t loop = std::min(size_t(share), size_t(num_loops) - 1);
    const double blend = 0.5 - 0.5 * std::cos(pi * (share - double(loop)));
    const double radius = (1 - blend) * radii[loop] + blend * radii[loop + 1];
    line.emplace_back(x - radius * std::sin(t), -radius * std::cos(t));
    x += 2 * pi / per_loop;
  }
  return line;
}

/// Circles on a way: the hand stops for each.
Polyline CircledLoops(int num_loops, Rng& rng) {
  const double unevenness = rng.Uniform(0, 0.45), spacing = LogUniform(0.6, 4, rng);
  PathPen pen;
  for (int i = 0; i < num_loops; ++i) {
    if (i > 0) pen.Forward(spacing * rng.Uniform(0.6, 1.4));
    const double turn = 2 * pi * rng.Uniform(0.86, 1.06);
    pen.Arc(turn, std::clamp(1 + Deviate(unevenness, rng), 0.5, 1.8)).Turn(2 * pi - turn);
  }
  return pen.points();
}

/// The loops with a way before and behind them, sheared and stretched.
Polyline WithEnds(const Polyline& loops, double size, Rng& rng) {
  const auto way = [&] { return size * (Happens(0.15, rng) ? rng.Uniform(0.15, 0.4) : LogUniform(0.3, 2.2, rng)); };
  const Vector2d in = loops[1] - loops[0], out = loops.back() - loops[loops.size() - 2];
  const Polyline before = PathPen(pi + std::atan2(in.y(), in.x()) + Deviate(0.1, rng))
                              .Arc(Deviate(0.22, rng), 2 * size)
                              .Forward(way())
                              .points();
  const Polyline behind = PathPen(std::atan2(out.y(), out.x()) + Deviate(0.1, rng))
                              .Forward(way())
                              .Arc(Deviate(0.22, rng), 2 * size)
                              .points();
  Polyline line;
  for (auto point = before.rbegin(); point != before.rend(); ++point) line.push_back(*point + loops.front());
  line = Joined(line, loops);
  for (const Vector2d& point : behind) line.push_back(point + loops.back());
  const double slope = Deviate(0.25, rng), height = LogUniform(0.65, 1.5, rng);
  for (Vector2d& point : line) point = {point.x() + slope * point.y(), height * point.y()};
  return Scaled(line, 1, EitherSign(rng));
}

Polyline RollShape(int num_loops, bool climbs, Rng& rng) {
  const double slant = rng.Uniform(kLeastSlant, kGreatestSlant) * kDegree;
  const Polyline roll = Aimed(DrawLoops(num_loops, rng), climbs ? -slant : slant);
  return Happens(0.3, rng) ? Reversed(roll) : roll;
}

}  // namespace

Polyline DrawShaft(Rng& rng) {
  // An arc of 0.5 radians deviates by 6 % of its chord.
  const double angle = Happens(0.7, rng) ? Deviate(0.2, rng) : 0;
  if (std::abs(angle) < 0.02) return PathPen().Forward(1).points();
  const Polyline arc = PathPen(-0.5 * angle).Arc(angle, 1 / std::abs(angle)).points();
  return Scaled(arc, 1 / arc.back().x(), 1 / arc.back().x());
}

Polyline DrawArrow(Rng& rng) {
  const Polyline arrow = ArrowAlongX(rng);
  return Happens(0.2, rng) ? Reversed(arrow) : arrow;
}

Polyline DrawLoops(int num_loops, Rng& rng) {
  Polyline line;
  double size = 0;
  do {
    const Polyline loops = Happens(0.55, rng) ? RoundLoops(num_loops, rng) : CircledLoops(num_loops, rng);
    size = BoxOf(loops).sizes().minCoeff();
    line = WithEnds(loops, size, rng);
  } while ((line.back() - line.front()).norm() < size);  // Its ends would meet, as those of a region.
  return line;
}

Polyline DrawGestureShape(Gesture gesture, Rng& rng) {
  switch (gesture) {
    case Gesture::kLine:
      return LineShape(rng);
    case Gesture::kRegion:
      return RegionShape(rng);
    case Gesture::kLeftArrow:
    case Gesture::kRightArrow:
      return ArrowShape(gesture == Gesture::kLeftArrow, rng);
    case Gesture::kUpRoll1:
    case Gesture::kUpRoll2:
    case Gesture::kUpRoll3:
      return RollShape(1 + int(gesture) - int(Gesture::kUpRoll1), true, rng);
    case Gesture::kDownRoll1:
    case Gesture::kDownRoll2:
    case Gesture::kDownRoll3:
      return RollShape(1 + int(gesture) - int(Gesture::kDownRoll1), false, rng);
    case Gesture::kNone:
      break;
  }
  throw Error("'none' has no shape of its own");
}

}  // namespace daumier::datasets
