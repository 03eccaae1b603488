#include "datasets/styles/page_lines.h"

#include "datasets/styles/head_ring.h"

#include <cmath>
#include <numbers>

namespace daumier::datasets {
namespace {

using Eigen::Vector2d;

enum class HatchPlace { kFace, kNeck };

/// Parallel lines inside an oval: those of the face on the head, those of the neck off it.
void HatchOval(const DrawingContext& drawing, HatchPlace hatched, const Vector2d& middle, double half_x, double half_y,
               double angle, int count) {
  const Vector2d along(std::cos(angle), std::sin(angle)), across(-along.y(), along.x());
  const Polyline head = drawing.shape.head();
  for (int i = 0; i < count; ++i) {
    if (drawing.Happens(0.1)) continue;
    const double place = -1 + 2 * (i + 0.5) / count + Deviate(0.15 / count, drawing.rng);
    const double reach = std::sqrt(std::max(0.0, 1 - place * place)) * drawing.Uniform(0.45, 1.15);
    const auto stretched = [&](const Vector2d& p) -> Vector2d {
      return middle + Vector2d(half_x * p.x(), half_y * p.y());
    };
    const Polyline line = {stretched(place * across - reach * along), stretched(place * across),
                           stretched(place * across + reach * along)};
    for (const LinePiece& piece : hatched == HatchPlace::kFace ? Inside(line, head) : Outside(line, head))
      drawing.sheet.AddMark(DrawnPart::kSkin, faces::LineLabel::kOther, piece.points);
  }
}

/// A line like writing: loops from left to right.
void AddWriting(const DrawingContext& drawing, const Vector2d& from, double size) {
  const int count = drawing.Count(4, 12);
  Polyline writing;
  for (int i = 0; i < 6 * count; ++i) {
    const double turn = 2 * std::numbers::pi * i / 6.0;
    writing.push_back(from +
                      size * Vector2d(0.13 * i + 0.35 * std::cos(turn), drawing.Uniform(0.3, 0.8) * std::sin(turn)));
  }
  drawing.sheet.Add(DrawnPart::kPage, faces::LineLabel::kOther, Smooth(writing, 18 * count)).care = LineCare::kShort;
}

}  // namespace

void DrawHatching(const DrawingContext& drawing) {
  if (!drawing.Happens(drawing.styles.extras.hatching)) return;
  const FaceShape& shape = drawing.shape;
  const double u = drawing.unit(), angle = drawing.Uniform(-1.3, 1.3), side = drawing.Happens(0.5) ? -1 : 1;
  const double density = drawing.Uniform(0.6, 1.6);
  const auto lines = [&](double count) { return std::max(3, static_cast<int>(count * density)); };
  const Vector2d mouth = shape.mouth_middle(), eyes = shape.eyes_middle, chin = shape.outline[size_t(shape.chin)];
  if (drawing.Happens(0.5))
    HatchOval(drawing, HatchPlace::kFace, 0.5 * (mouth + eyes) + Vector2d(side * 0.6 * u, 0), 0.16 * u, 0.35 * u, angle,
              lines(10));
  if (drawing.Happens(0.4))
    HatchOval(drawing, HatchPlace::kFace, 0.55 * eyes + 0.45 * mouth + Vector2d(side * 0.17 * u, 0), 0.06 * u, 0.2 * u,
              angle, lines(7));
  if (drawing.Happens(0.4))
    HatchOval(drawing, HatchPlace::kNeck, chin + Vector2d(0, 0.16 * u), 0.4 * u, 0.12 * u, angle, lines(14));
  if (drawing.Happens(0.3))
    HatchOval(drawing, HatchPlace::kFace, 0.5 * (mouth + chin), 0.18 * u, 0.06 * u, angle, lines(6));
  if (drawing.Happens(0.25))
    HatchOval(drawing, HatchPlace::kFace, eyes + Vector2d(-side * 0.2 * u, -0.75 * u), 0.3 * u, 0.15 * u, angle,
              lines(9));
}

void DrawConstruction(const DrawingContext& drawing) {
  if (!drawing.Happens(drawing.styles.extras.construction)) return;
  const HeadRing ring(drawing.shape);
  const auto add = [&](Polyline line) {
    drawing.sheet.Add(DrawnPart::kPage, faces::LineLabel::kOther, std::move(line)).width = 0.7;
  };
  const Vector2d mouth = drawing.shape.mouth_middle();
  if (drawing.Happens(0.8)) add(Smooth({ring.At(0, 1.03), 0.5 * (ring.middle() + mouth), ring.At(180, 1.05)}, 15));
  if (drawing.Happens(0.8)) add(Smooth({ring.At(-90, 1.03), drawing.shape.eyes_middle, ring.At(90, 1.03)}, 15));
  if (drawing.Happens(0.4)) add({mouth - Vector2d(0.7 * drawing.unit(), 0), mouth + Vector2d(0.7 * drawing.unit(), 0)});
  if (drawing.Happens(0.5)) {
    const double r = ring.Radius(0) * drawing.Uniform(0.9, 1.05);
    add(EllipseArc(ring.At(0, 0.1), r, r, -60, 330, 41));
  }
}

void DrawPageMarks(const DrawingContext& drawing) {
  if (!drawing.Happens(drawing.styles.extras.page_marks)) return;
  Eigen::AlignedBox2d box;
  for (const StyledLine& line : drawing.sheet.lines) box.extend(BoxOf(line.points));
  if (box.isEmpty()) return;
  const double u = drawing.unit();
  const Vector2d low = box.min() - Vector2d::Constant(0.2 * u), high = box.max() + Vector2d::Constant(0.2 * u);
  switch (drawing.Count(0, 3)) {
    case 0:  // A frame.
      drawing.sheet.Add(
          DrawnPart::kPage, faces::LineLabel::kOther,
          Joined(Joined(Resampled({low, {high.x(), low.y()}}, 9), Resampled({{high.x(), low.y()}, high}, 9)),
                 Joined(Resampled({high, {low.x(), high.y()}}, 9), Resampled({{low.x(), high.y()}, low}, 9))));
      return;
    case 1:  // A name in a corner below.
      return AddWriting(drawing,
                        {drawing.Uniform(low.x(), 0.5 * (low.x() + high.x())), high.y() - drawing.Uniform(0, 0.2) * u},
                        drawing.Uniform(0.1, 0.2) * u);
    case 2:  // A line across the page.
      drawing.sheet.Add(DrawnPart::kPage, faces::LineLabel::kOther,
                        {{low.x(), high.y()}, {0.5 * (low.x() + high.x()), high.y()}, high});
      return;
    default: {
      const int count = drawing.Count(1, 8);
      for (int i = 0; i < count; ++i) {
        const Vector2d spot(drawing.Uniform(low.x(), high.x()), drawing.Uniform(low.y(), high.y()));
        const double angle = drawing.Uniform(0, 2 * std::numbers::pi),
                     size = drawing.Happens(0.6) ? 0.01 * u : drawing.Uniform(0.02, 0.15) * u;
        drawing.sheet.AddMark(DrawnPart::kPage, faces::LineLabel::kOther,
                              {spot, spot + size * Vector2d(std::cos(angle), std::sin(angle))});
      }
    }
  }
}

}  // namespace daumier::datasets
