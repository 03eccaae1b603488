#include "datasets/gestures/test_plans.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::datasets {
namespace {

using Eigen::Vector2d;
using std::numbers::pi;

Vector2d UnitAt(double degrees) {
  return {std::cos(degrees * pi / 180), -std::sin(degrees * pi / 180)};
}

Polyline LumpOutline(Rng& rng) {
  Polyline knots;
  const int num_knots = 5 + static_cast<int>(rng.Below(4));
  for (int i = 0; i <= num_knots; ++i) {
    const double angle = 360.0 * i / num_knots;
    knots.push_back(i == num_knots ? knots.front() : Vector2d(rng.Uniform(0.7, 1.15) * UnitAt(angle)));
  }
  return Smooth(knots, 160);
}

/// A closed curve around the origin, about 2 wide.
Polyline SmoothOutline(Rng& rng) {
  const double height = rng.Uniform(0.5, 1), choice = rng.Uniform();
  if (choice < 0.15) return LumpOutline(rng);
  const double power = choice < 0.3 ? rng.Uniform(0.4, 0.7) : 1;                 // Below 1: towards a square.
  const double bow = choice > 0.75 && choice < 0.9 ? rng.Uniform(0.4, 0.7) : 0;  // A bean around a nose.
  const double taper = choice > 0.9 ? rng.Uniform(0.3, 0.6) : 0;                 // A drop.
  Polyline outline;
  for (int i = 0; i <= 160; ++i) {
    const Vector2d unit = UnitAt(360.0 * i / 160);
    const double x = std::copysign(std::pow(std::abs(unit.x()), power), unit.x());
    const double y = std::copysign(std::pow(std::abs(unit.y()), power), unit.y());
    outline.emplace_back(x, height * y * (bow > 0 ? 0.75 : 1) * (1 + taper * x) + bow * (x * x - 0.4));
  }
  return outline;
}

PenPlan PlanSmoothRegion(Rng& rng) {
  const Polyline outline = SmoothOutline(rng);
  const double start = rng.Uniform(), sense = Happens(0.5, rng) ? 1 : -1;
  const double sweep = Happens(0.4, rng) ? rng.Uniform(0.965, 1) : rng.Uniform(1, 1.09);
  const int num_points = 6 + static_cast<int>(rng.Below(4));
  const double miss = 1 + Deviate(0.05, rng);  // The end lies inside or outside of the start.
  const Vector2d centre = BoxOf(outline).center();
  PenPlan plan;
  for (int i = 0; i <= num_points; ++i) {
    const double share =
        start + sense * sweep * (i + (i > 0 && i < num_points ? rng.Uniform(-0.15, 0.15) : 0)) / num_points;
    const double factor = i == num_points ? miss : i + 1 == num_points ? (1 + miss) / 2 : 1;
    plan.push_back({centre + factor * (AtShare(outline, share - std::floor(share)) - centre)});
  }
  if (Happens(0.25, rng)) {  // A lasso: both ends run outwards and cross.
    const double tail = rng.Uniform(0.1, 0.25);
    const Vector2d first = plan[1].at - plan[0].at, last = plan[plan.size() - 1].at - plan[plan.size() - 2].at;
    plan.front().at += tail * ((plan.front().at - centre).normalized() - 0.5 * first.normalized());
    plan.back().at += tail * ((plan.back().at - centre).normalized() + 0.5 * last.normalized());
  }
  return plan;
}

/// Three to five corners, as of a box around something.
PenPlan PlanCorneredRegion(Rng& rng) {
  const int num_corners = Happens(0.7, rng) ? 4 : Happens(0.5, rng) ? 3 : 5;
  const double height = rng.Uniform(0.55, 1), first = rng.Uniform(-15, 15) + (num_corners == 4 ? 45 : 90);
  const bool is_round = Happens(0.4, rng), in_a_side = Happens(0.3, rng), clockwise = Happens(0.5, rng);
  PenPlan plan;
  for (int i = 0; i < num_corners; ++i) {
    Vector2d corner = UnitAt((clockwise ? -1 : 1) * (first + 360.0 * i / num_corners) + rng.Uniform(-7, 7));
    corner.y() *= height;
    plan.push_back({corner, !is_round});
  }
  const Vector2d start = in_a_side ? Vector2d((plan.front().at + plan.back().at) / 2) : plan.front().at;
  const Vector2d way = (start - plan.back().at).normalized();
  if (in_a_side) plan.insert(plan.begin(), ViaPoint{start});
  const double beyond = rng.Uniform(-0.13, 0.14);
  const Vector2d miss{Deviate(0.03, rng), Deviate(0.03, rng)};
  plan.push_back({start + beyond * way + miss});
  return plan;
}

}  // namespace

PenPlan FittedPlan(PenPlan plan, double extent_px) {
  Eigen::AlignedBox2d box;
  for (const ViaPoint& via : plan) box.extend(via.at);
  const double scale = extent_px / std::max(box.sizes().maxCoeff(), 1e-9);
  for (ViaPoint& via : plan) via.at = scale * (via.at - box.center());
  return plan;
}

PenPlan TurnedPlan(PenPlan plan, double degrees) {
  const Eigen::Rotation2Dd rotation(-degrees * pi / 180);
  for (ViaPoint& via : plan) via.at = rotation * via.at;
  return plan;
}

double DrawLogUniform(double low, double high, Rng& rng) {
  return low * std::pow(high / low, rng.Uniform());
}

PenPlan PlanTestLine(Rng& rng) {
  PenPlan plan = {{{-0.5, 0}}};
  const int num_aims = Happens(0.6, rng) ? 1 : 2 + static_cast<int>(rng.Below(2));
  const double bow = Deviate(0.012, rng);
  for (int i = 1; i < num_aims; ++i) {
    const double x = (i + rng.Uniform(-0.2, 0.2)) / num_aims - 0.5;
    plan.push_back({{x, bow * (1 - 4 * x * x)}});
  }
  plan.push_back({{0.5, 0}});
  // Half of the persons draw lines along the sheet or across it.
  const double side = 90.0 * static_cast<double>(rng.Below(4));
  const double degrees = Happens(0.5, rng) ? side + Deviate(6, rng) : rng.Uniform(0, 360);
  const double length = DrawLogUniform(45, 550, rng);
  for (ViaPoint& via : plan) via.at *= length;
  return TurnedPlan(plan, degrees);
}

PenPlan PlanTestRegion(Rng& rng) {
  const PenPlan plan = Happens(0.25, rng) ? PlanCorneredRegion(rng) : PlanSmoothRegion(rng);
  const double degrees = Happens(0.5, rng) ? Deviate(15, rng) : rng.Uniform(0, 360);
  return FittedPlan(TurnedPlan(plan, degrees), DrawLogUniform(45, 450, rng));
}

PenPlan PlanTestArrow(double direction_degrees, Rng& rng) {
  const bool two_barbs = Happens(0.65, rng);
  const double opening = rng.Uniform(22, 58), length = rng.Uniform(two_barbs ? 0.18 : 0.23, 0.42);
  const double side = Happens(0.5, rng) ? 1 : -1, bow = Deviate(0.03, rng);
  // Around the tip at the origin, the shaft to the left.
  const auto barb = [&](double sign) {
    const double barb_length = length * rng.Uniform(0.8, 1.2);
    return Vector2d(-barb_length * UnitAt(-sign * (opening + Deviate(5, rng))));
  };
  PenPlan plan = {{{-1, 0}}};
  if (Happens(0.4, rng)) plan.push_back({{-0.5, bow}});
  plan.push_back({{0, 0}, true});
  plan.push_back({barb(side), two_barbs});
  if (two_barbs) {
    // On its way to the other barb the pen returns to the tip, or nearly so.
    const double short_of = Happens(0.5, rng) ? 0 : rng.Uniform(0, 0.12);
    plan.push_back({{-short_of * length / 0.3, Deviate(0.015, rng)}, Happens(0.7, rng)});
    plan.push_back({barb(-side)});
  }
  if (Happens(0.2, rng)) std::reverse(plan.begin(), plan.end());
  return FittedPlan(TurnedPlan(plan, direction_degrees), DrawLogUniform(55, 500, rng));
}

PenPlan PlanTestRoll(int num_loops, double rise_degrees, Rng& rng) {
  DAUMIER_CHECK(num_loops > 0, "a roll has {} loops, expected at least 1", num_loops);
  const bool is_coil = Happens(0.45, rng);  // Overlapping loops, or loops apart as in writing.
  const double half_height = rng.Uniform(0.75, 1.9), spacing = is_coil ? rng.Uniform(0.7, 1.6) : rng.Uniform(1.8, 2.9);
  const double growth = rng.Uniform(0.87, 1.15), sense = Happens(0.65, rng) ? 1 : -1;
  const double lean = rng.Uniform(-0.3, 0.4), least = num_loops == 1 ? 1.3 : 0.7;
  const bool has_bottoms = Happens(0.7, rng), has_flat_ends = Happens(0.6, rng);
  // Along the way (x) and across it (y), half the width of a loop as the unit.
  PenPlan plan;
  const auto add = [&](double x, double y) { plan.push_back({{x + lean * y, y}}); };
  double centre = 0, size = 1;
  const double lead = rng.Uniform(least, 3);
  add(-lead, -half_height * rng.Uniform(0.6, 1.1));
  if (has_flat_ends) add(-0.15, -half_height);
  for (int i = 0; i < num_loops; ++i) {
    const double factor = size * (1 + Deviate(0.08, rng)), height = half_height * factor;
    if (i > 0 && has_bottoms) add(centre - spacing / 2 * size, -half_height * size * rng.Uniform(0.85, 1.1));
    add(centre + factor, height * rng.Uniform(-0.25, 0.25));
    add(centre + rng.Uniform(-0.15, 0.15), height);
    add(centre - factor, height * rng.Uniform(-0.25, 0.25));
    if (i + 1 < num_loops) centre += spacing * size * (1 + Deviate(0.1, rng)), size *= growth;
  }
  if (has_flat_ends) add(centre + 0.15 * size, -half_height * size);
  centre += size * rng.Uniform(least, 3);
  add(centre, -half_height * size * rng.Uniform(0.6, 1.1));
  for (ViaPoint& via : plan) via.at.y() *= -sense;
  const Vector2d ends = plan.back().at - plan.front().at;
  plan = TurnedPlan(plan, rise_degrees + std::atan2(ends.y(), ends.x()) * 180 / pi);
  return FittedPlan(plan, DrawLogUniform(60 + 25 * num_loops, 520, rng));
}

}  // namespace daumier::datasets
