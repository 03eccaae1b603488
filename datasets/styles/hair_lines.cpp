#include "datasets/styles/hair_lines.h"

#include "datasets/styles/hair_mass.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::datasets {
namespace {

using Eigen::Vector2d;
using Kind = HairChoice::Kind;

StyledLine& AddHair(const DrawingContext& drawing, Polyline line) {
  return drawing.sheet.Add(DrawnPart::kHair, faces::LineLabel::kHair, std::move(line));
}

StyledLine& AddHairMark(const DrawingContext& drawing, Polyline line) {
  return drawing.sheet.AddMark(DrawnPart::kHair, faces::LineLabel::kHair, std::move(line));
}

/// The borders of a mass as one line or as some, here and there with an open end.
void DrawBorders(const DrawingContext& drawing, const HairMass& mass) {
  const int num_pieces = drawing.Happens(0.5) ? 1 : drawing.Count(2, 3);
  for (int i = 0; i < num_pieces; ++i) {
    const double from = double(i) / num_pieces, to = double(i + 1) / num_pieces;
    const double gap = i + 1 < num_pieces ? drawing.Uniform(-0.02, 0.015) : 0;
    AddHair(drawing,
            Part(mass.outer, from, std::min(to - gap, 1.0), static_cast<int>(mass.outer.size()) / num_pieces + 2));
  }
  AddHair(drawing, mass.inner);
  for (const bool is_right : {true, false}) {
    const Vector2d& outer = is_right ? mass.outer.front() : mass.outer.back();
    const Vector2d& inner = is_right ? mass.inner.front() : mass.inner.back();
    if ((outer - inner).norm() < 0.08 * drawing.unit() || drawing.Happens(0.6)) continue;
    const Vector2d sag(0, drawing.Uniform(-0.05, 0.12) * drawing.unit());
    AddHair(drawing, Smooth({outer, (outer + inner) / 2 + sag, inner}, 7));
  }
}

/// Lines between the borders, along them.
void DrawStrands(const DrawingContext& drawing, const HairMass& mass) {
  constexpr int kPoints = 41;
  const Polyline outer = Resampled(mass.outer, kPoints), inner = Resampled(mass.inner, kPoints);
  const int count = drawing.Happens(0.3) ? drawing.Count(12, 36) : drawing.Count(3, 10);
  for (int i = 0; i < count; ++i) {
    const double depth = drawing.Uniform(0.12, 0.88), drift = drawing.Uniform(-0.25, 0.25);
    const double from = drawing.Uniform(0.02, 0.9), to = std::min(from + drawing.Uniform(0.06, 0.35), 0.98);
    const Polyline a = Part(outer, from, to, 12), b = Part(inner, from, to, 12);
    Polyline strand(12);
    for (size_t k = 0; k < strand.size(); ++k) {
      const double t = std::clamp(depth + drift * double(k) / 11, 0.05, 0.95);
      strand[k] = (1 - t) * a[k] + t * b[k];
    }
    AddHair(drawing, strand).care = LineCare::kShort;
  }
}

void DrawMass(const DrawingContext& drawing, const HairMass& mass) {
  LineSheet& sheet = drawing.sheet;
  sheet.CutInside(mass.polygon(), 0, sheet.lines.size());
  if (drawing.Happens(drawing.styles.hair.solid)) {
    StyledLine& area = AddHair(drawing, mass.polygon());
    area.care = LineCare::kShort;
    area.filled = true;
    return;
  }
  DrawBorders(drawing, mass);
  if (drawing.Happens(drawing.styles.hair.strands)) DrawStrands(drawing, mass);
}

/// Many short strokes round the crown, along the head or away from it.
void DrawShortStrokes(const DrawingContext& drawing) {
  const HeadRing ring(drawing.shape);
  const int count = drawing.Count(30, 110);
  const double reach = drawing.Uniform(60, 110), length = drawing.Uniform(0.06, 0.2), lean = drawing.Uniform(-30, 30);
  const double low = drawing.Uniform(0.78, 0.95), high = drawing.Uniform(1.0, 1.12);
  const bool is_profile = drawing.shape.view == faces::DrawnView::kProfile;
  const double from = is_profile ? -130 : -reach, to = is_profile ? 45 : reach;
  for (int i = 0; i < count; ++i) {
    const double angle = drawing.Uniform(from, to), tip_angle = angle + (lean + Deviate(25, drawing.rng)) * length;
    const double root = drawing.Uniform(low, high), tip = root + length * drawing.Uniform(0.5, 1.3);
    AddHairMark(drawing, {ring.At(angle, root), ring.At((angle + tip_angle) / 2, (root + tip) / 2 + 0.01),
                          ring.At(tip_angle, tip)});
  }
}

/// A scribble that stays inside a polygon as far as it can.
Polyline Scribble(const DrawingContext& drawing, const Polyline& polygon, const Vector2d& start, double step) {
  Polyline line = {start};
  double heading = drawing.Uniform(0, 2 * std::numbers::pi), bend = drawing.Uniform(-0.9, 0.9);
  const int count = drawing.Count(5, 16);
  for (int i = 0; i < count; ++i) {
    Vector2d next = line.back() + step * Vector2d(std::cos(heading), std::sin(heading));
    for (int turn = 0; turn < 3 && !IsInside(polygon, next); ++turn) {
      heading += 1.3;
      next = line.back() + step * Vector2d(std::cos(heading), std::sin(heading));
    }
    line.push_back(next);
    heading += bend;
    if (drawing.Happens(0.25)) bend = drawing.Uniform(-0.9, 0.9);
  }
  return Smooth(line, 2 * count + 1);
}

void DrawCurls(const DrawingContext& drawing) {
  HairPlan plan = DrawHairPlan(drawing.Happens(0.7) ? HairLength::kLong : HairLength::kShort, DrawHairline(drawing.rng),
                               drawing.rng);
  plan.side = drawing.Uniform(0.15, 0.4);
  plan.thickness = drawing.Uniform(0.1, 0.35);
  const HairMass mass = MakeHairMass(drawing.shape, plan, drawing.rng);
  const Polyline polygon = mass.polygon();
  LineSheet& sheet = drawing.sheet;
  sheet.CutInside(polygon, 0, sheet.lines.size());
  if (drawing.Happens(0.5)) AddHair(drawing, mass.inner);
  if (drawing.Happens(0.3)) AddHair(drawing, mass.outer);
  const int count = drawing.Count(20, 70);
  const double step = drawing.Uniform(0.05, 0.12) * drawing.unit();
  const Eigen::AlignedBox2d box = BoxOf(polygon);
  for (int i = 0, tries = 0; i < count && tries < 20 * count; ++tries) {
    const Vector2d start(drawing.Uniform(box.min().x(), box.max().x()), drawing.Uniform(box.min().y(), box.max().y()));
    if (!IsInside(polygon, start)) continue;
    AddHairMark(drawing, Scribble(drawing, polygon, start, step));
    ++i;
  }
}

/// A plait or a tail at a side, hanging down from a point.
void DrawTail(const DrawingContext& drawing, const Vector2d& root, double outward, bool is_plait) {
  const double u = drawing.unit(), length = drawing.Uniform(0.8, 1.9) * u, width = drawing.Uniform(0.12, 0.28) * u;
  const double flare = outward * drawing.Uniform(0, 0.35) * u;
  if (!is_plait) {
    const Vector2d tip = root + Vector2d(flare, length);
    const Vector2d side(outward * width, 0);
    AddHair(drawing, Smooth({root, root + Vector2d(0, 0.3 * length) + 1.4 * side,
                             root + Vector2d(flare, 0.7 * length) + side, tip},
                            17));
    AddHair(drawing, Smooth({root, root + Vector2d(0, 0.35 * length) - 0.4 * side,
                             root + Vector2d(flare, 0.75 * length) - 0.5 * side, tip},
                            17));
    return;
  }
  const int count = drawing.Count(4, 8);
  const double step = length / count;
  for (int i = 0; i < count; ++i) {
    const double side = i % 2 == 0 ? 1 : -1, size = width * (1 - 0.4 * double(i) / count);
    const Vector2d middle = root + Vector2d(flare * (i + 0.5) / count + side * 0.25 * size, step * (i + 0.5));
    AddHair(
        drawing,
        Smooth({middle + Vector2d(-side * 0.6 * size, -0.7 * step), middle + Vector2d(side * 0.6 * size, -0.3 * step),
                middle + Vector2d(side * 0.5 * size, 0.4 * step), middle + Vector2d(-side * 0.5 * size, 0.6 * step)},
               11))
        .care = LineCare::kShort;
  }
  const Vector2d end = root + Vector2d(flare, length);
  for (int i = -1; i <= 1; ++i) AddHairMark(drawing, {end, end + u * Vector2d(0.06 * i, drawing.Uniform(0.1, 0.2))});
}

void DrawTails(const DrawingContext& drawing) {
  HairPlan plan = DrawHairPlan(
      HairLength::kShort, drawing.Happens(0.5) ? Hairline::kMiddleParting : DrawHairline(drawing.rng), drawing.rng);
  plan.thickness = drawing.Uniform(0.03, 0.12);
  DrawMass(drawing, MakeHairMass(drawing.shape, plan, drawing.rng));
  const HeadRing ring(drawing.shape);
  const bool is_plait = drawing.Happens(0.5);
  const double angle = drawing.Uniform(80, 120);
  if (drawing.shape.view != faces::DrawnView::kProfile) DrawTail(drawing, ring.At(angle, 1.05), 1, is_plait);
  DrawTail(drawing, ring.At(-angle, 1.05), -1, is_plait);
}

void DrawBun(const DrawingContext& drawing) {
  HairPlan plan = DrawHairPlan(HairLength::kShort, Hairline::kRound, drawing.rng);
  plan.thickness = drawing.Uniform(0.02, 0.1);
  plan.ears = drawing.Uniform(70, 90);
  const HeadRing ring(drawing.shape);
  const double size = drawing.Uniform(0.2, 0.38) * ring.Radius(0),
               angle = drawing.shape.view == faces::DrawnView::kProfile ? drawing.Uniform(-70, -20)
                                                                        : drawing.Uniform(-25, 25);
  const Vector2d middle =
      ring.At(angle, 1.03 + plan.thickness) + 0.75 * size * (ring.At(angle, 1) - ring.middle()).normalized();
  DrawMass(drawing, MakeHairMass(drawing.shape, plan, drawing.rng));
  LineSheet& sheet = drawing.sheet;
  const Polyline circle = EllipseArc(middle, size, 0.85 * size, 90, 460, 25);
  const size_t begin = sheet.lines.size();
  AddHair(drawing, circle);
  // The bun is behind the crown.
  const Polyline crown = ring.Arc(-100, 100, 31, [&](double) { return 1.0 + 0.8 * plan.thickness; });
  sheet.CutInside(crown, begin, sheet.lines.size());
  if (drawing.Happens(0.5)) {
    Polyline swirl;
    for (int i = 0; i < 25; ++i) {
      const double t = double(i) / 24, turn = 2 * std::numbers::pi * 1.7 * t;
      swirl.push_back(middle + 0.7 * size * (1 - 0.8 * t) * Vector2d(std::cos(turn), 0.85 * std::sin(turn)));
    }
    AddHair(drawing, swirl).care = LineCare::kShort;
  }
}

/// A few lines, loops or a zigzag on the crown, or long curls at its sides.
void DrawFew(const DrawingContext& drawing) {
  const HeadRing ring(drawing.shape);
  const double r = ring.Radius(0);
  switch (DrawByWeight<5>({4, 1.5, 1.5, 2, 1}, drawing.rng)) {
    case 0: {  // Lines up.
      const int count = drawing.Count(1, 9);
      const double reach = drawing.Uniform(15, 75), length = drawing.Uniform(0.08, 0.4),
                   lean = drawing.Uniform(-25, 25);
      for (int i = 0; i < count; ++i) {
        const double angle =
            count == 1 ? Deviate(10, drawing.rng) : -reach + 2 * reach * i / (count - 1) + Deviate(5, drawing.rng);
        const double size = length * drawing.Uniform(0.6, 1.3), bend = drawing.Uniform(-0.1, 0.1) * r;
        const Vector2d root = ring.At(angle, drawing.Uniform(0.97, 1.03)), tip = ring.At(angle + lean * size, 1 + size);
        AddHair(drawing, Smooth({root, (root + tip) / 2 + Vector2d(bend, 0), tip}, 7)).care = LineCare::kShort;
      }
      return;
    }
    case 1: {  // A zigzag across.
      const int count = drawing.Count(5, 14);
      const double reach = drawing.Uniform(30, 85), high = drawing.Uniform(0.05, 0.25);
      Polyline zigzag;
      for (int i = 0; i < count; ++i)
        zigzag.push_back(
            ring.At(-reach + 2 * reach * i / (count - 1), (i % 2 == 0 ? 0.98 : 1 + high) + Deviate(0.03, drawing.rng)));
      AddHair(drawing, zigzag);
      return;
    }
    case 2: {  // Loops.
      const int count = drawing.Count(3, 9);
      const double size = drawing.Uniform(0.08, 0.2) * r, reach = drawing.Uniform(20, 90);
      Polyline loops;
      for (int i = 0; i < 9 * count; ++i) {
        const double t = double(i) / (9 * count - 1), turn = 2 * std::numbers::pi * count * t;
        loops.push_back(ring.At(-reach + 2 * reach * t, 1.02) + size * Vector2d(std::cos(turn), std::sin(turn)));
      }
      AddHair(drawing, loops).care = LineCare::kShort;
      return;
    }
    case 3: {  // Long lines at both sides.
      const int count = drawing.Count(1, 3);
      const double fall = drawing.Uniform(0.4, 1.6) * r;
      for (const double side : {-1.0, 1.0}) {
        for (int i = 0; i < count; ++i) {
          const Vector2d root = ring.At(side * (10 + 18 * i + Deviate(8, drawing.rng)), 1);
          const double out = r * drawing.Uniform(0.5, 1.1), y = root.y() + fall * drawing.Uniform(0.8, 1.2);
          Polyline line = Smooth({root,
                                  {root.x() + side * 0.6 * out, root.y() + 0.25 * fall},
                                  {root.x() + side * out, y - 0.3 * fall},
                                  {root.x() + side * out * drawing.Uniform(0.8, 1.2), y}},
                                 15);
          if (drawing.Happens(0.3)) line = Waved(line, 0.06 * r, drawing.Uniform(1, 3), 0);
          AddHair(drawing, line);
        }
      }
      return;
    }
    default: {  // A scribble on top.
      const int count = drawing.Count(12, 40);
      Polyline scribble;
      for (int i = 0; i < count; ++i) scribble.push_back(ring.At(Deviate(45, drawing.rng), drawing.Uniform(0.9, 1.25)));
      AddHair(drawing, Smooth(scribble, 3 * count)).care = LineCare::kShort;
    }
  }
}

}  // namespace

HairChoice ChooseHair(const DrawingContext& drawing) {
  const HairStyles& styles = drawing.styles.hair;
  HairChoice choice{};
  choice.kind =
      static_cast<Kind>(DrawByWeight<10>({styles.none, styles.short_cut, styles.long_cut, styles.swept, styles.spiky,
                                          styles.strokes, styles.curls, styles.tails, styles.bun, styles.few},
                                         drawing.rng));
  choice.hides_ears = choice.kind == Kind::kLong || choice.kind == Kind::kCurls;
  choice.border = HeadBorder::kWhole;
  const bool is_bare = choice.kind == Kind::kNone || choice.kind == Kind::kFew;
  if (is_bare && drawing.Happens(drawing.styles.head.open_top)) choice.border = HeadBorder::kOpenTop;
  if (choice.kind == Kind::kStrokes && drawing.Happens(0.75)) choice.border = HeadBorder::kOpenTop;
  return choice;
}

void DrawHair(const DrawingContext& drawing, const HairChoice& choice) {
  Rng& rng = drawing.rng;
  const auto mass = [&](HairLength length, Hairline hairline, double spikes = 0) {
    // Swept over the forehead of a turned face it would hide most of the face.
    if (!drawing.is_front() && hairline == Hairline::kSwept) hairline = Hairline::kSideParting;
    HairPlan plan = DrawHairPlan(length, hairline, rng);
    plan.spikes = spikes;
    DrawMass(drawing, MakeHairMass(drawing.shape, plan, rng));
  };
  switch (choice.kind) {
    case Kind::kNone:
      return;
    case Kind::kShort:
      return mass(HairLength::kShort, DrawHairline(rng));
    case Kind::kLong:
      return mass(HairLength::kLong, DrawHairline(rng));
    case Kind::kSwept:
      return mass(drawing.Happens(0.5) ? HairLength::kShort : HairLength::kLong, Hairline::kSwept);
    case Kind::kSpiky:
      return mass(HairLength::kShort, drawing.Happens(0.5) ? Hairline::kSpiky : DrawHairline(rng),
                  drawing.Uniform(0.06, 0.3));
    case Kind::kStrokes:
      return DrawShortStrokes(drawing);
    case Kind::kCurls:
      return DrawCurls(drawing);
    case Kind::kTails:
      return DrawTails(drawing);
    case Kind::kBun:
      return DrawBun(drawing);
    case Kind::kFew:
      return DrawFew(drawing);
  }
}

}  // namespace daumier::datasets
