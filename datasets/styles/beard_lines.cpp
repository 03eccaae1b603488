#include "datasets/styles/beard_lines.h"

#include <algorithm>

namespace daumier::datasets {
namespace {

using Eigen::Vector2d;

StyledLine& AddBeard(const DrawingContext& drawing, Polyline line) {
  return drawing.sheet.Add(DrawnPart::kHair, faces::LineLabel::kHair, std::move(line));
}

void AddBeardMark(const DrawingContext& drawing, const Vector2d& root, const Vector2d& tip) {
  drawing.sheet.AddMark(DrawnPart::kHair, faces::LineLabel::kHair, {root, (root + tip) / 2, tip});
}

/// Short strokes along the jaw, and over the mouth.
void DrawStubble(const DrawingContext& drawing) {
  const FaceShape& shape = drawing.shape;
  const double u = drawing.unit();
  const int count = drawing.Count(25, 90);
  const double from = drawing.Uniform(0.05, 0.3), depth = drawing.Uniform(0.1, 0.5);
  for (int i = 0; i < count; ++i) {
    const Vector2d jaw = AtShare(shape.outline, drawing.Uniform(from, 1 - from));
    const Vector2d root = jaw + drawing.Uniform(0.02, depth) * (shape.mouth_middle() - jaw);
    AddBeardMark(drawing, root, root + u * Vector2d(Deviate(0.05, drawing.rng), drawing.Uniform(0.03, 0.11)));
  }
}

void DrawMoustache(const DrawingContext& drawing) {
  const FaceShape& shape = drawing.shape;
  const double u = drawing.unit();
  const MouthShape& mouth = shape.mouth;
  const double width = drawing.Uniform(0.7, 1.3);
  const Vector2d lip = mouth.top[size_t(mouth.middle)],
                 nose = shape.nose.base.empty() ? lip - Vector2d(0, 0.2 * u) : shape.nose.base[NoseShape::kBaseMiddle];
  const Vector2d middle = 0.55 * lip + 0.45 * nose;
  if (drawing.Happens(0.4)) {  // Short strokes.
    const int count = drawing.Count(12, 40);
    const double half = 0.5 * width * (mouth.top.front() - mouth.top.back()).norm();
    for (int i = 0; i < count; ++i) {
      const double across = drawing.Uniform(-1, 1);
      const Vector2d root =
          middle + Vector2d(across * half, drawing.Uniform(-0.04, 0.04) * u + 0.06 * u * across * across);
      AddBeardMark(drawing, root, root + u * Vector2d(0.05 * across, drawing.Uniform(0.04, 0.1)));
    }
    return;
  }
  const bool is_filled = drawing.Happens(0.3);
  const double curl = drawing.Uniform(-0.12, 0.15) * u, thick = drawing.Uniform(0.06, 0.16) * u;
  for (const bool is_right : {true, false}) {
    const Vector2d corner = is_right ? mouth.top.front() : mouth.top.back();
    const Vector2d end = middle + width * (corner - middle) + Vector2d(0, -curl);
    const Vector2d half = (middle + end) / 2;
    Polyline loop = Smooth({middle, half - Vector2d(0, 0.6 * thick), end, half + Vector2d(0, 0.6 * thick),
                            middle + Vector2d(0, 0.3 * thick)},
                           21);
    StyledLine& line = AddBeard(drawing, std::move(loop));
    line.filled = is_filled;
    line.care = LineCare::kShort;
  }
}

void DrawFullBeard(const DrawingContext& drawing) {
  const FaceShape& shape = drawing.shape;
  const double u = drawing.unit();
  const double from = drawing.Happens(0.5) ? 0 : drawing.Uniform(0.2, 0.36);  // All round, or the chin alone.
  const double length = drawing.Uniform(0.05, 0.6) * u, wave = drawing.Uniform(0, 0.04) * u;
  Polyline outer = Part(shape.outline, from, 1 - from, 33), inner = outer;
  const Vector2d mouth = shape.mouth_middle(), chin = shape.outline[size_t(shape.chin)];
  const double reach = std::max((chin - mouth).y(), 0.1 * u), inset = drawing.Uniform(0.2, 0.45);
  for (size_t i = 0; i < outer.size(); ++i) {
    const double low = std::clamp((outer[i].y() - mouth.y()) / reach, 0.0, 1.0);
    outer[i] += Vector2d(0, length * low * low);
    inner[i] += inset * (0.4 + 0.6 * low) * (mouth + Vector2d(0, 0.25 * reach) - inner[i]);
  }
  if (wave > 0) outer = Waved(Resampled(outer, 65), wave, drawing.Uniform(6, 16), 0);
  inner.front() = outer.front();
  inner.back() = outer.back();
  LineSheet& sheet = drawing.sheet;
  Polyline polygon = Joined(outer, Reversed(inner));
  sheet.CutInside(polygon, 0, sheet.lines.size());
  AddBeard(drawing, outer);
  AddBeard(drawing, inner);
  if (!drawing.Happens(0.6)) return;
  const int count = drawing.Count(8, 40);
  for (int i = 0; i < count; ++i) {
    const double at = drawing.Uniform(0.1, 0.9), deep = drawing.Uniform(0.1, 0.8);
    const Vector2d root = (1 - deep) * AtShare(inner, at) + deep * AtShare(outer, at);
    AddBeardMark(drawing, root, root + u * Vector2d(Deviate(0.04, drawing.rng), drawing.Uniform(0.05, 0.15)));
  }
}

}  // namespace

void DrawBeard(const DrawingContext& drawing) {
  const HairStyles& styles = drawing.styles.hair;
  if (drawing.shape.view == faces::DrawnView::kProfile || !drawing.sheet.mouth) return;
  if (drawing.is_front() && drawing.Happens(styles.beard)) DrawFullBeard(drawing);
  if (drawing.Happens(styles.moustache)) DrawMoustache(drawing);
  if (drawing.Happens(styles.stubble)) DrawStubble(drawing);
}

}  // namespace daumier::datasets
