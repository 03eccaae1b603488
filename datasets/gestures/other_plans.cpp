#include "datasets/gestures/other_plans.h"

#include "core/error.h"
#include "datasets/gestures/test_plans.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::datasets {
namespace {

using Eigen::Vector2d;
using std::numbers::pi;

constexpr bool kCornerHere = true;

const std::vector<PenPlan>& Glyphs() {
  constexpr bool c = kCornerHere;
  static const std::vector<PenPlan> kGlyphs = {
      {{{0, 1.2}}, {{.1, 0}, c}, {{.5, .9}, c}, {{.9, 0}, c}, {{1, 1.2}}},                        // M
      {{{0, 1.2}}, {{.05, 0}, c}, {{.8, 1.2}, c}, {{.85, 0}}},                                    // N
      {{{0, 0}}, {{.25, 1}, c}, {{.5, .2}, c}, {{.75, 1}, c}, {{1, 0}}},                          // W
      {{{0, 0}}, {{.9, 0}, c}, {{0, 1.1}, c}, {{.95, 1.1}}},                                      // Z
      {{{.8, .15}}, {{.4, 0}}, {{.05, .3}}, {{.45, .6}}, {{.8, .9}}, {{.4, 1.2}}, {{0, 1.05}}},   // S
      {{{0, 0}}, {{.05, .8}}, {{.4, 1.1}}, {{.75, .8}}, {{.8, 0}}},                               // U
      {{{.85, .1}}, {{.4, 0}}, {{0, .55}}, {{.4, 1.1}}, {{.9, 1}}},                               // C
      {{{.8, .1}}, {{.4, 0}}, {{0, .55}}, {{.4, 1.1}}, {{.8, 1}}, {{.85, .62}, c}, {{.5, .62}}},  // G
      {{{0, 0}}, {{0, 1.2}, c}, {{.05, .7}}, {{.35, .5}}, {{.6, .7}}, {{.62, 1.2}}},              // h
      {{{0, .4}}, {{0, 1.1}, c}, {{.05, .65}}, {{.35, .42}}, {{.6, .65}}, {{.62, 1.1}}},          // n
      {{{0, .4}},
       {{0, 1.1}, c},
       {{.2, .45}},
       {{.4, .6}},
       {{.42, 1.1}, c},
       {{.65, .45}},
       {{.85, .6}},
       {{.87, 1.1}}},                                                                                     // m
      {{{0, .3}}, {{0, 1.1}, c}, {{.08, .55}}, {{.35, .33}}, {{.55, .42}}},                               // r
      {{{0, 0}}, {{.1, .45}}, {{.4, .55}}, {{.65, 0}, c}, {{.62, .8}}, {{.3, 1.2}}, {{0, 1.05}}},         // y
      {{{0, 0}}, {{0, 1.2}, c}, {{.05, .8}, c}, {{.6, .4}, c}, {{.1, .75}, c}, {{.65, 1.2}}},             // k
      {{{0, .25}}, {{.4, 0}}, {{.75, .3}}, {{.4, .75}}, {{0, 1.15}, c}, {{.85, 1.12}}},                   // 2
      {{{0, .1}}, {{.4, 0}}, {{.65, .25}}, {{.25, .52}, c}, {{.7, .85}}, {{.35, 1.15}}, {{0, 1}}},        // 3
      {{{.15, 0}}, {{0, .6}, c}, {{.75, .6}, c}, {{.7, .1}, c}, {{.68, 1.2}}},                            // 4
      {{{.75, 0}}, {{.15, .02}, c}, {{.1, .5}, c}, {{.5, .45}}, {{.8, .8}}, {{.45, 1.15}}, {{0, 1.05}}},  // 5
      {{{0, 0}}, {{.75, 0}, c}, {{.25, 1.2}}},                                                            // 7
      {{{0, .35}}, {{.35, 0}, c}, {{.35, 1.2}}},                                                          // 1
      {{{.8, 0}}, {{0, 0}, c}, {{.45, .55}, c}, {{0, 1.1}, c}, {{.85, 1.1}}},                             // sum
      {{{.7, .1}}, {{.3, 0}}, {{.05, .25}}, {{.35, .5}, c}, {{0, .8}}, {{.3, 1.1}}, {{.75, .95}}},        // E
      {{{0, .3}}, {{.3, 0}}, {{.7, .25}}, {{.45, .65}}, {{.35, .85}}, {{.36, 1.2}}},                      // ?
      {{{.6, 0}}, {{.6, .9}}, {{.3, 1.2}}, {{0, .95}}},                                                   // J
      {{{.5, 0}}, {{0, .65}, c}, {{.5, .55}, c}, {{.1, 1.2}}},                                            // lightning
      {{{.35, 0}}, {{0, 0}, c}, {{0, 1.2}, c}, {{.35, 1.2}}},                                             // [
      {{{.4, 0}}, {{.2, .15}}, {{.2, .45}}, {{0, .6}, c}, {{.2, .75}}, {{.2, 1.05}}, {{.4, 1.2}}},        // {
      {{{0, 0}}, {{.3, 0}, c}, {{.3, .3}, c}, {{.6, .3}, c}, {{.6, .6}, c}, {{.9, .6}}}};                 // stairs
  return kGlyphs;
}

Vector2d OnUnitCircle(double degrees) {
  return {std::cos(degrees * pi / 180), -std::sin(degrees * pi / 180)};
}

PenPlan PlanGlyph(Rng& rng) {
  PenPlan plan = Glyphs()[rng.Below(Glyphs().size())];
  const double slant = rng.Uniform(-0.35, 0.1), width = rng.Uniform(0.75, 1.3);
  for (ViaPoint& via : plan) via.at.x() = width * via.at.x() + slant * via.at.y();
  return TurnedPlan(plan, Deviate(5, rng));
}

PenPlan PlanZigzag(Rng& rng) {
  const int num_turns = 3 + static_cast<int>(rng.Below(7));
  const double step = rng.Uniform(0.25, 0.7);
  const bool is_round = Happens(0.3, rng);
  PenPlan plan;
  for (int i = 0; i <= num_turns; ++i) {
    plan.push_back({{step * i + Deviate(0.05, rng), (i % 2 == 0 ? 0.5 : -0.5) + Deviate(0.08, rng)}, !is_round});
  }
  return TurnedPlan(plan, Happens(0.5, rng) ? Deviate(10, rng) : rng.Uniform(0, 360));
}

PenPlan PlanSpiral(Rng& rng) {
  const double turns = rng.Uniform(2.2, 4), start = rng.Uniform(0, 360), sense = Happens(0.5, rng) ? 1 : -1;
  const double height = rng.Uniform(0.7, 1);
  PenPlan plan;
  for (int i = 0; i <= static_cast<int>(turns * 4); ++i) {
    const double radius = 0.08 + 0.92 * i / (turns * 4) + Deviate(0.02, rng);
    const Vector2d point = radius * OnUnitCircle(start + sense * 90 * i);
    plan.push_back({{point.x(), height * point.y()}});
  }
  if (Happens(0.4, rng)) std::reverse(plan.begin(), plan.end());
  return plan;
}

PenPlan PlanTick(Rng& rng) {
  const double rise = rng.Uniform(48, 68), fall = rng.Uniform(40, 70);
  PenPlan plan = {{-rng.Uniform(0.25, 0.5) * OnUnitCircle(-fall)}, {{0, 0}, Happens(0.7, rng)}, {OnUnitCircle(rise)}};
  return plan;
}

PenPlan PlanArc(Rng& rng) {
  const double sweep = rng.Uniform(80, 240), start = rng.Uniform(0, 360), height = rng.Uniform(0.75, 1);
  PenPlan plan;
  const int count = sweep > 150 ? 4 : 2;
  for (int i = 0; i <= count; ++i) {
    const Vector2d point = OnUnitCircle(start + sweep * i / count);
    plan.push_back({{point.x(), height * point.y()}});
  }
  if (Happens(0.5, rng)) std::reverse(plan.begin(), plan.end());
  return plan;
}

PenPlan PlanWave(Rng& rng) {
  const int num_halves = 2 + static_cast<int>(rng.Below(5));
  const double height = rng.Uniform(0.8, 1.4), sign = Happens(0.5, rng) ? 1 : -1;
  PenPlan plan = {{{-0.5, 0}}};
  for (int i = 0; i < num_halves; ++i) {
    plan.push_back({{i + Deviate(0.08, rng), sign * (i % 2 == 0 ? height : -height) * rng.Uniform(0.8, 1.2)}});
  }
  plan.push_back({{num_halves - 0.5, 0}});
  return TurnedPlan(plan, Happens(0.6, rng) ? Deviate(10, rng) : rng.Uniform(0, 360));
}

PenPlan PlanStar(Rng& rng) {
  const double start = 90 + Deviate(10, rng), sense = Happens(0.5, rng) ? 144 : -144;
  PenPlan plan;
  for (int i = 0; i < 5; ++i) plan.push_back({OnUnitCircle(start + sense * (i - 0.5)), true});
  plan.push_back({plan.back().at + rng.Uniform(0.2, 0.45) * (plan.front().at - plan.back().at)});
  return plan;
}

PenPlan PlanOpenHeart(Rng& rng) {
  const double far = rng.Uniform(0.3, 0.5);
  PenPlan plan = {{{0, -.3}}, {{.25, -.6}}, {{.55, -.35}}, {{0, .55}, true}, {{-.5, -.05}}, {{-.55, far - .75}}};
  if (Happens(0.5, rng)) {
    for (ViaPoint& via : plan) via.at.x() *= -1;
  }
  if (Happens(0.5, rng)) std::reverse(plan.begin(), plan.end());
  return TurnedPlan(plan, Deviate(8, rng));
}

PenPlan PlanOpenPolygon(Rng& rng) {
  const int num_corners = 4 + static_cast<int>(rng.Below(2));
  const double start = rng.Uniform(0, 360), height = rng.Uniform(0.7, 1);
  PenPlan plan;
  for (int i = 0; i < num_corners; ++i) {  // The last side is missing.
    const Vector2d corner = OnUnitCircle(start + 360.0 * i / num_corners + Deviate(4, rng));
    plan.push_back({{corner.x(), height * corner.y()}, true});
  }
  return plan;
}

PenPlan PlanCorner(Rng& rng) {
  const bool is_v = Happens(0.5, rng);
  const double opening = is_v ? rng.Uniform(25, 65) : rng.Uniform(80, 98), other = rng.Uniform(0.85, 1.2);
  const double upright = Happens(0.7, rng) ? 90 : -90, aslant = 45 + 90.0 * static_cast<double>(rng.Below(4));
  const double middle = is_v ? upright + Deviate(12, rng) : aslant + Deviate(5, rng);
  PenPlan plan = {{OnUnitCircle(middle - opening / 2)}, {{0, 0}, true}, {other * OnUnitCircle(middle + opening / 2)}};
  if (Happens(0.5, rng)) std::reverse(plan.begin(), plan.end());
  return plan;
}

/// Crosses the sheet without rising or falling as a roll does.
PenPlan PlanScribble(Rng& rng) {
  const double side = Happens(0.5, rng) ? 1 : -1, height = rng.Uniform(-0.5, 0.5);
  PenPlan plan = {{{-side, height}}};
  const int num_aims = 6 + static_cast<int>(rng.Below(9));
  while (static_cast<int>(plan.size()) < num_aims) {
    const Vector2d point{rng.Uniform(-1, 1), rng.Uniform(-0.7, 0.7)};
    if ((point - plan.back().at).norm() > 0.5) plan.push_back({point, Happens(0.3, rng)});
  }
  plan.push_back({{side, height + Deviate(0.05, rng)}});
  return plan;
}

/// A head of two barbs at each end; the pen starts at a barb of the left head.
PenPlan PlanDoubleArrow(Rng& rng) {
  const bool two_barbs = Happens(0.6, rng);
  const double opening = rng.Uniform(two_barbs ? 25 : 35, 55), length = rng.Uniform(0.2, 0.35);
  const auto barb = [&](double side, double sign) {
    const double barb_length = length * rng.Uniform(0.8, 1.2);
    const Vector2d way = barb_length * OnUnitCircle(opening + Deviate(5, rng));
    return Vector2d(side * (0.5 - way.x()), sign * way.y());
  };
  PenPlan plan = {{barb(-1, 1)}, {{-0.5, 0}, true}};
  if (two_barbs) plan.insert(plan.end(), {{barb(-1, -1), true}, {{-0.5, 0}, true}});
  plan.insert(plan.end(), {{{0.5, 0}, true}, {barb(1, 1), true}});
  if (two_barbs) plan.insert(plan.end(), {{{0.5, 0}, true}, {barb(1, -1)}});
  return TurnedPlan(plan, Happens(0.7, rng) ? Deviate(8, rng) : rng.Uniform(0, 360));
}

PenPlan PlanDot(Rng& rng) {
  PenPlan plan = {{{0, 0}}};
  const int num_aims = 1 + static_cast<int>(rng.Below(3));
  for (int i = 0; i < num_aims; ++i) plan.push_back({{rng.Uniform(-1, 1), rng.Uniform(-1, 1)}});
  return plan;
}

/// A comma or a small upright hook.
PenPlan PlanShortHook(Rng& rng) {
  const double side = Happens(0.5, rng) ? 1 : -1;
  PenPlan plan = {{{0, -0.5}}, {{0.1 * side, 0.2}}, {{-0.15 * side, 0.5}}, {{-0.45 * side, rng.Uniform(0.2, 0.4)}}};
  const double upside = Happens(0.5, rng) ? 180 : 0;
  return TurnedPlan(plan, upside + Deviate(8, rng));
}

}  // namespace

PenPlan PlanOtherStroke(OtherStroke kind, Rng& rng) {
  const double extent = DrawLogUniform(45, 500, rng), sign = Happens(0.5, rng) ? 1 : -1;
  switch (kind) {
    case OtherStroke::kGlyph:
      return FittedPlan(PlanGlyph(rng), extent);
    case OtherStroke::kZigzag:
      return FittedPlan(PlanZigzag(rng), extent);
    case OtherStroke::kSpiral:
      return FittedPlan(PlanSpiral(rng), extent);
    case OtherStroke::kTick:
      return FittedPlan(PlanTick(rng), extent);
    case OtherStroke::kArc:
      return FittedPlan(PlanArc(rng), extent);
    case OtherStroke::kWave:
      return FittedPlan(PlanWave(rng), extent);
    case OtherStroke::kStar:
      return FittedPlan(PlanStar(rng), extent);
    case OtherStroke::kOpenHeart:
      return FittedPlan(PlanOpenHeart(rng), extent);
    case OtherStroke::kOpenPolygon:
      return FittedPlan(PlanOpenPolygon(rng), extent);
    case OtherStroke::kCorner:
      return FittedPlan(PlanCorner(rng), extent);
    case OtherStroke::kScribble:
      return FittedPlan(PlanScribble(rng), extent);
    case OtherStroke::kVerticalArrow:
      return PlanTestArrow(90 * sign + Deviate(8, rng), rng);
    case OtherStroke::kDoubleArrow:
      return FittedPlan(PlanDoubleArrow(rng), extent);
    case OtherStroke::kLongRoll: {
      const int num_loops = 4 + static_cast<int>(rng.Below(3));
      return PlanTestRoll(num_loops, sign * rng.Uniform(20, 65), rng);
    }
    case OtherStroke::kFlatCoil: {
      const int num_loops = 2 + static_cast<int>(rng.Below(3));
      const double rise = Happens(0.5, rng) ? 90 * sign : 0;
      return PlanTestRoll(num_loops, rise + Deviate(1.5, rng), rng);
    }
    case OtherStroke::kDot:
      return FittedPlan(PlanDot(rng), 1 + extent / 80);
    case OtherStroke::kShortHook:
      return FittedPlan(PlanShortHook(rng), 9 + extent / 20);
  }
  throw Error("there is no such stroke");
}

}  // namespace daumier::datasets
