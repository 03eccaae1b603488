#include "datasets/styles/hair_mass.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::datasets {
namespace {

using Eigen::Vector2d;

constexpr double kTurn = 2 * std::numbers::pi;

/// A place on the forehead: across it from the right end of the hairline (0) to the left one (1), the middle of the
/// face at 0.5; and a share of the head's radius.
struct HairlinePoint {
  double across, share;
};

/// The hairline between its ends, for a hairline `high` at the middle of the forehead.
std::vector<HairlinePoint> HairlinePoints(Hairline kind, double high, Rng& rng) {
  const auto about = [&](double value, double spread) { return value + Deviate(spread, rng); };
  switch (kind) {
    case Hairline::kRound:
      return {{0.06, about(0.9, 0.03)}, {0.2, about(0.88, 0.02)}, {0.35, high + 0.06},     {0.5, high},
              {0.65, high + 0.06},      {0.8, about(0.88, 0.02)}, {0.94, about(0.9, 0.03)}};
    case Hairline::kFringe: {
      const double low = rng.Uniform(0.42, 0.62);
      return {{0.07, about(0.86, 0.03)},
              {0.14, about(0.8, 0.02)},
              {0.24, low + 0.22},
              {0.38, low + 0.06},
              {0.5, low},
              {0.62, low + 0.06},
              {0.76, low + 0.22},
              {0.86, about(0.8, 0.02)},
              {0.93, about(0.86, 0.03)}};
    }
    case Hairline::kMiddleParting: {
      const double part = 0.5 + Deviate(0.05, rng);
      return {{0.07, 0.86}, {0.18, about(0.82, 0.03)}, {0.32, about(0.8, 0.03)}, {part - 0.03, 0.94},
              {part, 1.0},  {part + 0.03, 0.94},       {0.68, about(0.8, 0.03)}, {0.82, about(0.82, 0.03)},
              {0.93, 0.86}};
    }
    case Hairline::kSideParting: {
      const double part = rng.Uniform(0.25, 0.38), low = rng.Uniform(0.5, 0.72);
      std::vector<HairlinePoint> points = {
          {0.07, 0.87}, {0.16, about(0.84, 0.02)}, {part - 0.05, 0.88}, {part, 0.97}, {part + 0.12, 0.5 * (low + 0.9)},
          {0.6, low},   {0.74, low + 0.08},        {0.88, 0.83},        {0.95, 0.9}};
      if (rng.Uniform() < 0.5) {
        std::reverse(points.begin(), points.end());
        for (HairlinePoint& point : points) point.across = 1 - point.across;
      }
      return points;
    }
    case Hairline::kPeak:
      return {{0.06, 0.9},        {0.15, about(0.84, 0.02)}, {0.24, about(0.86, 0.02)}, {0.36, high + 0.1},
              {0.5, high - 0.06}, {0.64, high + 0.1},        {0.76, about(0.86, 0.02)}, {0.85, about(0.84, 0.02)},
              {0.94, 0.9}};
    case Hairline::kSwept: {
      const double part = rng.Uniform(0.3, 0.42), low = rng.Uniform(0.2, 0.6);
      std::vector<HairlinePoint> points = {{0.06, 0.9},  {0.15, 0.87},        {part - 0.08, 0.9},
                                           {part, 0.98}, {part + 0.08, 0.86}, {0.6, low + 0.12},
                                           {0.75, low},  {0.88, low + 0.25},  {0.96, 0.9}};
      if (rng.Uniform() < 0.5) {
        std::reverse(points.begin(), points.end());
        for (HairlinePoint& point : points) point.across = 1 - point.across;
      }
      return points;
    }
    default: {
      std::vector<HairlinePoint> points = {{0.06, 0.9}};
      const int count = 5 + static_cast<int>(rng.Below(6));
      for (int i = 0; i < count; ++i) {
        const double across = 0.14 + 0.72 * i / (count - 1);
        const double base = high + 0.06 + 0.1 * std::abs(across - 0.5) * 2;
        points.push_back({across, base - (i % 2 == 1 ? rng.Uniform(0.06, 0.2) : 0)});
      }
      points.push_back({0.94, 0.9});
      return points;
    }
  }
}

/// Slow irregularity of a border: sines of random phases.
class Unevenness {
 public:
  Unevenness(double size, Rng& rng) {
    for (int i = 0; i < 4; ++i)
      waves_.push_back({size * rng.Uniform(0.2, 1) / (1 + 0.4 * i), 1.0 + i + rng.Uniform(), rng.Uniform()});
  }
  double At(double t) const {
    double sum = 0;
    for (const Wave& wave : waves_) sum += wave.size * std::sin(kTurn * (wave.count * t + wave.phase));
    return sum;
  }

 private:
  struct Wave {
    double size, count, phase;
  };
  std::vector<Wave> waves_;
};

Polyline WithSpikes(const HeadRing& ring, const Polyline& border, double height, Rng& rng) {
  const int count = 8 + static_cast<int>(rng.Below(12));
  const double lean = rng.Uniform(-0.5, 0.5);
  Polyline spiky;
  for (int i = 0; i < count; ++i) {
    const double at = double(i) / count;
    spiky.push_back(AtShare(border, at));
    const Vector2d root = AtShare(border, at + (0.5 + lean * 0.5) / count);
    const double angle = ring.AngleOf(root);
    spiky.push_back(root + rng.Uniform(0.5, 1.2) * height * (ring.At(angle, 1) - ring.middle()));
  }
  spiky.push_back(border.back());
  return spiky;
}

/// Hair that hangs down at a side: the outer border from the ear down, and the inner one.
struct HangingSide {
  Polyline outer, inner;
};

HangingSide HangDown(const FaceShape& shape, const Vector2d& outer_from, const Vector2d& inner_from, double outward,
                     const HairPlan& plan, Rng& rng) {
  const double u = shape.unit, bottom = shape.eyes_middle.y() + plan.fall * u;
  const double drop = std::max(bottom - outer_from.y(), 0.2 * u);
  const double flare = rng.Uniform(-0.1, 0.35) * u, bulge = rng.Uniform(0, 0.15) * u;
  const Vector2d outer_end = outer_from + Vector2d(outward * flare, drop);
  HangingSide side;
  side.outer = Smooth({outer_from, outer_from + Vector2d(outward * (bulge + flare * 0.2), 0.35 * drop),
                       outer_from + Vector2d(outward * (bulge + flare * 0.7), 0.7 * drop), outer_end},
                      13);
  // The inner border follows the cheek, then the neck.
  const double end_y = outer_end.y() - rng.Uniform(-0.05, 0.3) * u;
  const Vector2d inner_end(inner_from.x() + outward * rng.Uniform(-0.2, 0.15) * u, end_y);
  const Vector2d cheek(inner_from.x() + outward * rng.Uniform(-0.05, 0.1) * u,
                       inner_from.y() + 0.5 * (end_y - inner_from.y()));
  side.inner = Smooth({inner_from, cheek, inner_end}, 11);
  if (rng.Uniform() < 0.4) {
    const double waves = rng.Uniform(1.5, 4), size = rng.Uniform(0.02, 0.07) * u, phase = rng.Uniform();
    side.outer = Waved(Resampled(side.outer, 25), size, waves, phase);
    side.inner = Waved(Resampled(side.inner, 21), 0.7 * size, waves, phase);
  }
  return side;
}

HairMass ProfileMass(const FaceShape& shape, const HairPlan& plan, Rng& rng) {
  const HeadRing ring(shape);
  const double front = ring.AngleOf(shape.outline.front()), nape = ring.AngleOf(shape.skull.front());
  const Unevenness uneven(0.03, rng);
  const double from = nape > 0 ? nape - 360 : nape;  // The back lies at negative angles.
  HairMass mass;
  mass.outer = ring.Arc(from, front, 41, [&](double t) {
    return 1 + plan.side + (plan.thickness - plan.side) * std::sin(std::numbers::pi * t) +
           uneven.At(t) * t * (1 - t) * 4;
  });
  const double ear_top = shape.ears[0].outer.empty() ? shape.eyes_middle.y() : shape.ears[0].outer.front().y();
  const Vector2d ear(shape.ears[0].outer.empty() ? ring.middle().x() : BoxOf(shape.ears[0].outer).center().x(),
                     ear_top);
  const double u = shape.unit;
  const Vector2d above = ear - Vector2d(0, rng.Uniform(0.05, 0.25) * u),
                 before = ear + Vector2d(rng.Uniform(0.2, 0.35) * u, rng.Uniform(-0.1, 0.2) * u);
  const Vector2d behind = ear + Vector2d(-rng.Uniform(0.3, 0.5) * u, 0.35 * u);
  const Vector2d temple = 0.5 * (before + shape.outline.front()) + Vector2d(-0.05 * u, -0.15 * u);
  mass.inner = Smooth({mass.outer.front(), behind, above, before, temple, shape.outline.front()}, 31);
  mass.outer.back() = mass.inner.back();
  if (plan.length == HairLength::kLong) {
    const Vector2d back = mass.outer.front();
    const HangingSide side = HangDown(shape, back, behind, -1, plan, rng);
    mass.outer = Joined(Reversed(side.outer), mass.outer);
    mass.inner = Joined(Reversed(side.inner), Polyline(mass.inner.begin() + 6, mass.inner.end()));
  }
  return mass;
}

}  // namespace

Hairline DrawHairline(Rng& rng) {
  return static_cast<Hairline>(DrawByWeight<7>({3, 1.5, 1.5, 2, 1, 0.8, 0.8}, rng));
}

HairPlan DrawHairPlan(HairLength length, Hairline hairline, Rng& rng) {
  HairPlan plan;
  plan.length = length;
  plan.hairline = hairline;
  plan.thickness = rng.Uniform(0.04, 0.28);
  plan.side = rng.Uniform(0.0, length == HairLength::kLong ? 0.2 : 0.1);
  plan.ears = rng.Uniform(78, 108);
  plan.fall = rng.Uniform(0.7, 2.3);
  return plan;
}

HairMass MakeHairMass(const FaceShape& shape, const HairPlan& plan, Rng& rng) {
  if (shape.view == faces::DrawnView::kProfile) return ProfileMass(shape, plan, rng);
  const HeadRing ring(shape);
  const Unevenness uneven(0.025, rng), uneven_line(0.02, rng);
  const double square = rng.Uniform() < 0.25 ? rng.Uniform(0.03, 0.1) : 0, lean = Deviate(0.3, rng);
  const double right = -plan.ears + Deviate(4, rng), left = plan.ears + Deviate(4, rng);
  HairMass mass;
  mass.outer = ring.Arc(right, left, 45, [&](double t) {
    const double round = std::sin(std::numbers::pi * t);
    const double corner = square * std::pow(std::sin(kTurn * t), 2);
    return 1 + plan.side + (plan.thickness - plan.side) * round * (1 + lean * (t - 0.5)) + corner +
           uneven.At(t) * round;
  });
  if (plan.spikes > 0) mass.outer = WithSpikes(ring, mass.outer, plan.spikes, rng);

  // Across the forehead of a turned face the middle lies at the hairline's own angle.
  const double forehead = std::clamp(ring.AngleOf(shape.hairline), 0.6 * right, 0.6 * left);
  const double high = std::clamp(ring.ShareOf(shape.hairline) + Deviate(0.06, rng), 0.45, 0.9);
  const auto at = [&](const HairlinePoint& point) {
    const double angle = point.across < 0.5 ? right + (forehead - right) * point.across / 0.5
                                            : forehead + (left - forehead) * (point.across - 0.5) / 0.5;
    return ring.At(angle, point.share + uneven_line.At(point.across));
  };
  Polyline hairline = {ring.At(right, 1 + 0.3 * plan.side)};
  for (const HairlinePoint& point : HairlinePoints(plan.hairline, high, rng)) hairline.push_back(at(point));
  hairline.push_back(ring.At(left, 1 + 0.3 * plan.side));
  mass.inner = plan.hairline == Hairline::kSpiky ? hairline : Smooth(hairline, 49);
  if (plan.length == HairLength::kShort) return mass;

  // Long hair covers the ears: its inner border goes down from the temples.
  const auto from = static_cast<size_t>(plan.hairline == Hairline::kSpiky ? 1 : 5);
  const Polyline across(mass.inner.begin() + ptrdiff_t(from), mass.inner.end() - ptrdiff_t(from));
  const HangingSide right_side = HangDown(shape, mass.outer.front(), across.front(), -1, plan, rng);
  const HangingSide left_side = HangDown(shape, mass.outer.back(), across.back(), 1, plan, rng);
  const auto tail = [](const Polyline& line) { return Polyline(line.begin() + 1, line.end()); };
  mass.outer = Joined(Joined(Reversed(tail(right_side.outer)), mass.outer), tail(left_side.outer));
  mass.inner = Joined(Joined(Reversed(tail(right_side.inner)), across), tail(left_side.inner));
  return mass;
}

}  // namespace daumier::datasets
