#include "datasets/gestures/pen_motion.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace daumier::datasets {
namespace {

using Eigen::Vector2d;
using std::numbers::pi;

/// An aimed movement along a circular arc.
struct AimedArc {
  Vector2d chord;
  double bend = 0;  ///< Radians by which the direction turns, clockwise on the sheet.
  double onset_s = 0, duration_s = 0;

  double Length() const {
    const double half = bend / 2;
    return chord.norm() * (std::abs(half) < 1e-4 ? 1 : half / std::sin(half));
  }

  /// The way from its start after a share of its length.
  Vector2d At(double share) const {
    if (std::abs(bend) < 1e-4) return share * chord;
    const double from = std::atan2(chord.y(), chord.x()) - bend / 2, to = from + bend * share;
    return Length() / bend * Vector2d(std::sin(to) - std::sin(from), std::cos(from) - std::cos(to));
  }
};

double AngleBetween(const Vector2d& a, const Vector2d& b) {
  return std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
}

double NormalShare(double x) {
  return 0.5 * std::erfc(-x / std::numbers::sqrt2);
}

/// The share of an arc that is covered after a share of its duration.
double CoveredShare(double time, const WriterHand& hand) {
  if (time <= 0 || time >= 1) return time <= 0 ? 0 : 1;
  if (hand.model != HandModel::kLognormal) return time * time * time * (10 + time * (6 * time - 15));
  // The lognormal speed from three deviations below its median to three above.
  const double low = std::exp(-3 * hand.skewness), high = std::exp(3 * hand.skewness);
  const double z = std::log(low + time * (high - low)) / hand.skewness;
  return (NormalShare(z) - NormalShare(-3)) / (NormalShare(3) - NormalShare(-3));
}

/// The plan with ticks at its ends and with errors of aim.
PenPlan Aimed(const PenPlan& plan, const WriterHand& hand, Rng& rng) {
  Eigen::AlignedBox2d box;
  for (const ViaPoint& via : plan) box.extend(via.at);
  const double size = box.sizes().maxCoeff();
  PenPlan aimed;
  if (hand.landing > 0) {
    const double angle = rng.Uniform(-pi, pi);
    aimed.push_back({plan.front().at + hand.landing * size * Vector2d(std::cos(angle), std::sin(angle)), true});
  }
  Vector2d error(0, 0);
  for (size_t i = 0; i < plan.size(); ++i) {
    if (i > 0) {
      const double deviation = hand.aim_noise * (plan[i].at - plan[i - 1].at).norm();
      error = (1 - hand.correction) * error + Vector2d{Deviate(deviation, rng), Deviate(deviation, rng)};
    }
    aimed.push_back({plan[i].at + error, plan[i].corner});
  }
  if (hand.drag > 0) {
    const Vector2d last = aimed.back().at - aimed[aimed.size() - 2].at;
    const double angle = std::atan2(last.y(), last.x()) + Deviate(0.7, rng);
    aimed.back().corner = true;
    aimed.push_back({aimed.back().at + hand.drag * size * Vector2d(std::cos(angle), std::sin(angle)), true});
  }
  return aimed;
}

/// The direction at a smooth point, that of the chord between its neighbours.
std::optional<Vector2d> TangentAt(const PenPlan& plan, size_t i) {
  if (i == 0 || i + 1 == plan.size() || plan[i].corner) return std::nullopt;
  return plan[i + 1].at - plan[i - 1].at;
}

std::vector<AimedArc> ArcsOf(const PenPlan& plan, const WriterHand& hand, Rng& rng) {
  std::vector<AimedArc> arcs;
  double onset = 0;
  for (size_t i = 0; i + 1 < plan.size(); ++i) {
    AimedArc arc{plan[i + 1].at - plan[i].at};
    const auto from = TangentAt(plan, i), to = TangentAt(plan, i + 1);
    // Half of the bend lies before the chord's direction and half behind; a free end repeats most of the other one.
    const double first = from ? AngleBetween(*from, arc.chord) : 0, second = to ? AngleBetween(arc.chord, *to) : 0;
    arc.bend = std::clamp((from && to ? 1 : 1.5) * (first + second) + Deviate(hand.bend_noise, rng), -3.6, 3.6);
    arc.duration_s = hand.tempo_s * std::pow(std::max(arc.Length(), 1.0) / 80, 0.4) * (1 + 0.1 * std::abs(arc.bend));
    arc.onset_s = onset;
    onset += arc.duration_s * (1 - (plan[i + 1].corner ? hand.corner_overlap : hand.overlap));
    arcs.push_back(arc);
  }
  return arcs;
}

Polyline Superposed(const Vector2d& start, const std::vector<AimedArc>& arcs, const WriterHand& hand) {
  double end = 0;
  for (const AimedArc& arc : arcs) end = std::max(end, arc.onset_s + arc.duration_s);
  Polyline path;
  for (int tick = 0; tick <= static_cast<int>(std::ceil(1000 * end)); ++tick) {
    Vector2d point = start;
    for (const AimedArc& arc : arcs) {
      point += arc.At(CoveredShare((0.001 * tick - arc.onset_s) / arc.duration_s, hand));
    }
    path.push_back(point);
  }
  return path;
}

/// A mass that follows a moving point on a damped spring, semi-implicit Euler at one millisecond.
Polyline PulledBySpring(Polyline path, const WriterHand& hand) {
  const double stiffness = std::pow(2 * pi * hand.spring_hz, 2);
  const double friction = 2 * hand.damping * 2 * pi * hand.spring_hz;
  // The pen is lifted about when the mass arrives: its delay is 2 damping / (2 pi frequency).
  const int delay_ms = static_cast<int>(1000 * 3 * hand.damping / (pi * hand.spring_hz));
  path.insert(path.end(), static_cast<size_t>(delay_ms), Vector2d(path.back()));
  Vector2d point = path.front(), velocity(0, 0);
  for (Vector2d& target : path) {
    velocity += 0.001 * (stiffness * (target - point) - friction * velocity);
    point += 0.001 * velocity;
    target = point;
  }
  return path;
}

void AddTremor(Polyline& path, const WriterHand& hand, Rng& rng) {
  const double drift_px = hand.drift * BoxOf(path).sizes().maxCoeff();
  double phases[4], rates_hz[2];
  for (double& phase : phases) phase = rng.Uniform(0, 2 * pi);
  for (double& rate : rates_hz) rate = rng.Uniform(0.6, 2.2);
  const Vector2d start = drift_px * Vector2d(std::sin(phases[2]), std::sin(phases[3]));
  for (size_t i = 0; i < path.size(); ++i) {
    for (int axis = 0; axis < 2; ++axis) {
      phases[axis] += 2 * pi * hand.tremor_hz / 1000 + 0.15 * rng.Uniform(-1, 1);  // The frequency wanders.
      const double slow = std::sin(phases[2 + axis] + 2 * pi * rates_hz[axis] * 0.001 * static_cast<double>(i));
      path[i][axis] += hand.tremor_px * std::sin(phases[axis]) + drift_px * slow - start[axis];
    }
  }
}

/// Without the first and last share of the length.
Polyline WithoutEnds(const Polyline& path, double from, double to) {
  const std::vector<double> arcs = ArcLengths(path);
  Polyline rest;
  for (size_t i = 0; i < path.size(); ++i) {
    if (arcs[i] >= from * arcs.back() && arcs[i] <= (1 - to) * arcs.back()) rest.push_back(path[i]);
  }
  return rest.size() < 2 ? path : rest;
}

}  // namespace

WriterHand DrawWriterHand(Rng& rng) {
  WriterHand hand;
  hand.model = static_cast<HandModel>(rng.Below(3));
  hand.tempo_s = rng.Uniform(0.07, 0.2);
  hand.overlap = rng.Uniform(0.12, 0.36);
  hand.corner_overlap = Happens(0.5, rng) ? 0 : rng.Uniform(0, 0.25);
  hand.skewness = rng.Uniform(0.15, 0.4);
  hand.spring_hz = std::max(rng.Uniform(4.5, 8), 0.7 / hand.tempo_s);  // Nobody moves faster than the arm follows.
  hand.damping = rng.Uniform(0.5, 0.95);
  hand.aim_noise = rng.Uniform(0.01, 0.05);
  hand.correction = rng.Uniform(0.3, 0.8);
  hand.bend_noise = rng.Uniform(0, 0.12);
  hand.tremor_px = 0.9 * std::pow(rng.Uniform(), 2);
  hand.tremor_hz = rng.Uniform(8, 12);
  hand.drift = rng.Uniform(0, 0.01);
  if (Happens(0.2, rng)) hand.landing = rng.Uniform(0.01, 0.03);
  if (Happens(0.2, rng)) hand.drag = rng.Uniform(0.01, 0.04);
  if (Happens(0.2, rng)) hand.cut_start = rng.Uniform(0.01, 0.04);
  if (Happens(0.2, rng)) hand.cut_end = rng.Uniform(0.01, 0.04);
  return hand;
}

Polyline MovePen(const PenPlan& plan, const WriterHand& hand, Rng& rng) {
  DAUMIER_CHECK(plan.size() >= 2, "the plan of a stroke has {} points, expected at least 2", plan.size());
  const PenPlan aimed = Aimed(plan, hand, rng);
  Polyline path = Superposed(aimed.front().at, ArcsOf(aimed, hand, rng), hand);
  if (hand.model == HandModel::kSpring) path = PulledBySpring(std::move(path), hand);
  AddTremor(path, hand, rng);
  return WithoutEnds(path, hand.cut_start, hand.cut_end);
}

}  // namespace daumier::datasets
