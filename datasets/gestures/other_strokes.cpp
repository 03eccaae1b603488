#include "datasets/gestures/other_strokes.h"

#include "datasets/gestures/drawing_strokes.h"
#include "datasets/gestures/gesture_shapes.h"
#include "datasets/gestures/glyph_strokes.h"
#include "datasets/gestures/near_gestures.h"
#include "datasets/gestures/path_pen.h"
#include "datasets/gestures/stroke_form.h"

#include <array>
#include <cmath>
#include <numbers>

namespace daumier::datasets {
namespace {

using Eigen::Vector2d;
using std::numbers::pi;

Polyline AnyWay(const Polyline& line, Rng& rng) {
  const Polyline mirrored = Scaled(line, EitherSign(rng), 1);
  return Turned(mirrored, rng.Uniform(-pi, pi));
}

Polyline ArcStroke(Rng& rng) {
  // Of curvature that grows, and stretched: from a bow of 0.15 of its chord to three quarters of a ring.
  const double angle = rng.Uniform(1.2, 4.9), growth = Happens(0.5, rng) ? rng.Uniform(-0.7, 0.7) : 0;
  PathPen pen;
  constexpr int kPieces = 30;
  for (int i = 0; i < kPieces; ++i) pen.Arc(angle / kPieces, 1 + growth * (2.0 * i / kPieces - 1));
  const Polyline stretched = Scaled(pen.points(), 1, LogUniform(0.5, 2, rng));
  return AnyWay(stretched, rng);
}

Polyline WaveStroke(Rng& rng) {
  const double waves = rng.Uniform(0.9, 6), height = LogUniform(0.12, 0.6, rng) / std::max(1.0, 0.4 * waves);
  const bool is_scalloped = Happens(0.3, rng);
  const double phase = rng.Uniform();
  Polyline line;
  for (int i = 0; i < 300; ++i) {
    const double x = i / 299.0, y = std::sin(2 * pi * (waves * x + phase));
    line.emplace_back(x, 2 * height * (is_scalloped ? std::abs(y) : 0.5 * y));
  }
  const double bow = Deviate(0.2, rng);
  for (Vector2d& point : line) point.y() += bow * point.x() * (1 - point.x());
  return AnyWay(line, rng);
}

Polyline ZigzagStroke(Rng& rng) {
  const int num_peaks = 2 + int(rng.Below(7));
  const bool has_stairs = Happens(0.2, rng);
  const double height = LogUniform(0.25, 2, rng), unevenness = rng.Uniform(0, 0.3);
  Polyline corners = {Vector2d::Zero()};
  for (int i = 0; i <= num_peaks; ++i) {
    const Vector2d step = has_stairs ? (i % 2 == 0 ? Vector2d(1, 0) : Vector2d(0, 1.2 * height))
                                     : Vector2d(1, i % 2 == 0 ? height : -height);
    corners.push_back(corners.back() + step * (1 + unevenness * Deviate(1, rng)));
  }
  return AnyWay(Resampled(corners, 300), rng);
}

Polyline SpiralStroke(Rng& rng) {
  const double turns = rng.Uniform(1.8, 4.5), inner = rng.Uniform(0, 0.35);
  Polyline line;
  for (int i = 0; i < 400; ++i) {
    const double t = i / 399.0, radius = inner + (1 - inner) * t, angle = 2 * pi * turns * t;
    line.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  line = AnyWay(Scaled(line, 1, LogUniform(0.55, 1, rng)), rng);
  return Happens(0.5, rng) ? Reversed(line) : line;
}

Polyline CornerStroke(Rng& rng) {
  const double kind = rng.Uniform();
  if (kind < 0.25) {  // A tick: the long arm climbs steeply.
    const double climb = rng.Uniform(0.65, 1.3), inside = rng.Uniform(0.9, 1.9);
    Polyline line = {rng.Uniform(0.25, 0.55) * Vector2d(std::cos(-climb - inside), std::sin(-climb - inside)),
                     Vector2d::Zero(), Vector2d(std::cos(climb), -std::sin(climb))};
    line = Resampled(line, 200);
    return Happens(0.15, rng) ? Scaled(line, -1, 1) : line;
  }
  const bool is_wedge = kind < 0.45;
  const double inside = is_wedge ? rng.Uniform(0.15, 0.6) : rng.Uniform(0.6, 2.2);
  const double arm = is_wedge || inside < 1.2 ? rng.Uniform(0.65, 1) : rng.Uniform(0.4, 1);
  const Polyline corner = {{1, 0}, {0, 0}, {arm * std::cos(inside), arm * std::sin(inside)}};
  return AnyWay(Resampled(corner, 200), rng);
}

Polyline OpenPolygonStroke(Rng& rng) {
  const int num_corners = 3 + int(rng.Below(5));
  const double jitter = rng.Uniform(0, 0.15), share = rng.Uniform(0.45, 0.78);
  Polyline corners;
  for (int i = 0; i <= num_corners; ++i) {
    const double angle = 2 * pi * (i + jitter * rng.Normal()) / num_corners;
    corners.emplace_back(std::cos(angle), std::sin(angle));
  }
  return AnyWay(Scaled(Part(corners, 0, share, 240), 1, LogUniform(0.45, 1, rng)), rng);
}

Polyline ScribbleStroke(Rng& rng) {
  if (Happens(0.4, rng)) {  // Hatching.
    const int num_lines = 4 + int(rng.Below(12));
    const double step = rng.Uniform(0.03, 0.2);
    Polyline corners;
    for (int i = 0; i < num_lines; ++i)
      corners.push_back(Vector2d{0.15 * rng.Normal() + (i % 2 == 0 ? 0 : 1), step * (i + 0.3 * rng.Normal())});
    return AnyWay(Happens(0.6, rng) ? Smooth(corners, 400) : Resampled(corners, 400), rng);
  }
  Polyline through;
  const int num_points = 6 + int(rng.Below(14));
  for (int i = 0; i < num_points; ++i) through.push_back(Vector2d{rng.Normal(), rng.Normal()});
  return AnyWay(Smooth(through, 500), rng);
}

Polyline WanderingStroke(Rng& rng) {
  const int num_pieces = 2 + int(rng.Below(5));
  PathPen pen(rng.Uniform(-pi, pi));
  for (int i = 0; i < num_pieces; ++i) {
    const double size = LogUniform(0.15, 1, rng), kind = rng.Uniform();
    if (kind < 0.4)
      pen.Forward(size);
    else if (kind < 0.85)
      pen.Arc(Deviate(1.8, rng), 0.6 * size);
    else
      pen.Arc(Signed(4, 7, rng), 0.25 * size);
    if (Happens(0.55, rng)) pen.Turn(Signed(0.6, 2.9, rng));
  }
  return pen.points();
}

Polyline DrawOnce(OtherStrokeKind kind, Rng& rng) {
  switch (kind) {
    case OtherStrokeKind::kGlyph:
      return DrawGlyph(rng);
    case OtherStrokeKind::kArc:
      return ArcStroke(rng);
    case OtherStrokeKind::kWave:
      return WaveStroke(rng);
    case OtherStrokeKind::kZigzag:
      return ZigzagStroke(rng);
    case OtherStrokeKind::kSpiral:
      return SpiralStroke(rng);
    case OtherStrokeKind::kCorner:
      return CornerStroke(rng);
    case OtherStrokeKind::kOpenPolygon:
      return OpenPolygonStroke(rng);
    case OtherStrokeKind::kScribble:
      return ScribbleStroke(rng);
    case OtherStrokeKind::kManyLoops:
      return ManyLoops(rng);
    case OtherStrokeKind::kLevelLoops:
      return LevelLoops(rng);
    case OtherStrokeKind::kMixedLoops:
      return MixedLoops(rng);
    case OtherStrokeKind::kTurnedArrow:
      return TurnedArrow(rng);
    case OtherStrokeKind::kDoubleArrow:
      return DoubleArrow(rng);
    case OtherStrokeKind::kBrokenArrow:
      return BrokenArrow(rng);
    case OtherStrokeKind::kTailedRegion:
      return TailedRegion(rng);
    case OtherStrokeKind::kDrawing:
      return DrawingStroke(rng);
    case OtherStrokeKind::kWandering:
      return WanderingStroke(rng);
  }
  return {};
}

/// What is drawn without regard to gestures may be one by chance; near misses are none by how they are made.
bool IsNone(OtherStrokeKind kind, const Polyline& line) {
  using enum OtherStrokeKind;
  if (kind == kWandering || kind == kScribble || kind == kOpenPolygon) return !MayBeGesture(line);
  const StrokeForm form = FormOf(line);
  return !form.is_nearly_straight() && !form.is_nearly_closed();
}

}  // namespace

std::string NameOf(OtherStrokeKind kind) {
  static constexpr std::array kNames = {"glyph",       "arc",          "wave",         "zigzag",       "spiral",
                                        "corner",      "open_polygon", "scribble",     "many_loops",   "level_loops",
                                        "mixed_loops", "turned_arrow", "double_arrow", "broken_arrow", "tailed_region",
                                        "drawing",     "wandering"};
  return kNames[size_t(kind)];
}

Polyline DrawOtherShape(OtherStrokeKind kind, Rng& rng) {
  Polyline line;
  do line = DrawOnce(kind, rng);
  while (!IsNone(kind, line));
  return line;
}

}  // namespace daumier::datasets
