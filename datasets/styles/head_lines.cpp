#include "datasets/styles/head_lines.h"

#include <algorithm>
#include <cmath>

namespace daumier::datasets {
namespace {

using Eigen::Vector2d;
using enum faces::FacePoint;

/// The point between two indices whose height is nearest to y.
int AtHeight(const Polyline& line, int begin, int end, double y) {
  int best = begin;
  for (int i = begin; i < end; ++i)
    if (std::abs(line[size_t(i)].y() - y) < std::abs(line[size_t(best)].y() - y)) best = i;
  return best;
}

/// Of a profile: where the nose meets the upper lip.
int NoseBottomOf(const FaceShape& shape) {
  const Polyline& outline = shape.outline;
  const int lip = NearestIndex(outline, shape.mouth.top.back());
  int tip = 0;
  for (int i = 0; i < lip; ++i)
    if (outline[size_t(i)].x() > outline[size_t(tip)].x()) tip = i;
  int bottom = tip;
  for (int i = tip; i < lip; ++i)
    if (outline[size_t(i)].x() < outline[size_t(bottom)].x()) bottom = i;
  return bottom;
}

std::vector<LineAnchor> OutlineAnchors(const FaceShape& shape, int offset) {
  if (shape.view == faces::DrawnView::kProfile)
    return {{kChin, shape.chin + offset}, {kNoseBottom, NoseBottomOf(shape) + offset}};
  const double y = shape.mouth_middle().y();
  const int last = static_cast<int>(shape.outline.size());
  return {{kChin, shape.chin + offset},
          {kContourRight, AtHeight(shape.outline, 0, shape.chin, y) + offset},
          {kContourLeft, AtHeight(shape.outline, shape.chin, last, y) + offset}};
}

StyledLine& AddSilhouette(const DrawingContext& drawing, Polyline line, std::vector<LineAnchor> anchors = {}) {
  return drawing.sheet.Add(DrawnPart::kOutline, faces::LineLabel::kSilhouette, std::move(line), std::move(anchors));
}

/// A short curve near a point of the face.
void AddFold(const DrawingContext& drawing, const Polyline& through) {
  drawing.sheet.Add(DrawnPart::kSkin, faces::LineLabel::kWrinkle, Smooth(through, 9));
}

void DrawFolds(const DrawingContext& drawing) {
  const FaceShape& shape = drawing.shape;
  const double u = drawing.unit();
  if (drawing.Happens(0.6) && !shape.mouth.top.empty()) {  // From the nose past the corners of the mouth.
    const double length = drawing.Uniform(0.6, 1.1);
    for (size_t side = 0; side < 2; ++side) {
      const double outward = side == 0 ? -1 : 1;
      if (shape.nose.wings[side].empty()) continue;
      const Vector2d from = shape.nose.wings[side].back() + u * Vector2d(outward * 0.08, -0.02);
      const Vector2d corner =
          (side == 0 ? shape.mouth.top.front() : shape.mouth.top.back()) + u * Vector2d(outward * 0.1, 0);
      const Vector2d to = from + length * (corner - from);
      AddFold(drawing, {from, (from + to) / 2 + u * Vector2d(outward * 0.05, 0), to});
    }
  }
  if (drawing.Happens(0.4) && drawing.is_front()) {  // Across the forehead.
    const int count = drawing.Count(1, 3);
    const double half = drawing.Uniform(0.2, 0.5) * u;
    for (int i = 0; i < count; ++i) {
      const Vector2d middle = shape.eyes_middle + Vector2d(Deviate(0.1 * u, drawing.rng), -u * (0.5 + 0.13 * i));
      const double bend = drawing.Uniform(-0.08, 0.08) * u;
      AddFold(drawing, {middle - Vector2d(half, bend), middle, middle + Vector2d(half, -bend)});
    }
  }
  if (drawing.Happens(0.35) && shape.view != faces::DrawnView::kProfile) {  // Below the mouth.
    const Vector2d middle = shape.mouth_middle() + 0.55 * (shape.outline[size_t(shape.chin)] - shape.mouth_middle());
    const double half = drawing.Uniform(0.08, 0.25) * u, bend = drawing.Uniform(-0.06, 0.06) * u;
    AddFold(drawing, {middle - Vector2d(half, bend), middle, middle + Vector2d(half, -bend)});
  }
  if (!drawing.Happens(0.3)) return;
  for (size_t side = 0; side < 2; ++side) {  // At the outer corners of the eyes.
    const EyeShape& eye = shape.eyes[side];
    if (!eye.is_seen()) continue;
    const double outward = side == 0 ? -1 : 1;
    for (int i = 0; i < 3; ++i) {
      const Vector2d from = eye.upper.front() + u * Vector2d(outward * 0.06, 0.05 * (i - 1));
      AddFold(drawing, {from, from + u * Vector2d(outward * drawing.Uniform(0.05, 0.12), 0.06 * (i - 1))});
    }
  }
}

void DrawFreckles(const DrawingContext& drawing) {
  const FaceShape& shape = drawing.shape;
  const double u = drawing.unit();
  const int count = drawing.Happens(0.4) ? 1 : drawing.Count(6, 24);
  for (int i = 0; i < count; ++i) {
    const Vector2d spot = 0.6 * shape.eyes_middle + 0.4 * shape.mouth_middle() +
                          u * Vector2d(drawing.Uniform(-0.6, 0.6), drawing.Uniform(-0.2, 0.3));
    drawing.sheet.AddMark(DrawnPart::kSkin, faces::LineLabel::kOther, EllipseArc(spot, 0.01 * u, 0.01 * u, 0, 360, 5));
  }
}

/// Circles, spirals or hatching on the cheeks.
void DrawCheeks(const DrawingContext& drawing) {
  const FaceShape& shape = drawing.shape;
  const double u = drawing.unit(), size = drawing.Uniform(0.08, 0.18) * u;
  const bool is_hatched = drawing.Happens(0.4);
  for (const double side : {-1.0, 1.0}) {
    const Vector2d cheek = 0.45 * shape.eyes_middle + 0.55 * shape.mouth_middle() + Vector2d(side * 0.62 * u, 0);
    if (!is_hatched) {
      drawing.sheet.Add(DrawnPart::kSkin, faces::LineLabel::kOther, EllipseArc(cheek, size, 0.8 * size, 0, 370, 17))
          .care = LineCare::kShort;
      continue;
    }
    for (int i = -2; i <= 2; ++i) {
      const Vector2d middle = cheek + Vector2d(0.4 * size * i, 0);
      drawing.sheet.AddMark(DrawnPart::kSkin, faces::LineLabel::kOther,
                            {middle + Vector2d(-0.2 * size, 0.5 * size), middle + Vector2d(0.2 * size, -0.5 * size)});
    }
  }
}

}  // namespace

void DrawOutline(const DrawingContext& drawing, HeadBorder border) {
  const FaceShape& shape = drawing.shape;
  if (border == HeadBorder::kOpenTop || shape.skull.empty()) {
    AddSilhouette(drawing, shape.outline, OutlineAnchors(shape, 0));
    return;
  }
  if (shape.view == faces::DrawnView::kProfile) {
    AddSilhouette(drawing, shape.outline, OutlineAnchors(shape, 0));
    AddSilhouette(drawing, shape.skull);
    return;
  }
  const Polyline first = Part(shape.skull, 0.5, 1, 21), last = Part(shape.skull, 0, 0.5, 21);
  // The border behind the ears is often left out.
  const bool has_ears = std::any_of(drawing.sheet.lines.begin(), drawing.sheet.lines.end(),
                                    [](const StyledLine& line) { return line.part == DrawnPart::kEars; });
  if (has_ears && drawing.Happens(0.5)) {
    AddSilhouette(drawing, shape.outline, OutlineAnchors(shape, 0));
    AddSilhouette(drawing, shape.skull);
    return;
  }
  AddSilhouette(drawing, Joined(Joined(first, shape.outline), last),
                OutlineAnchors(shape, static_cast<int>(first.size())));
}

void DrawEars(const DrawingContext& drawing) {
  if (!drawing.Happens(drawing.styles.head.ears)) return;
  const bool has_inner = drawing.Happens(drawing.styles.head.inner_ears);
  for (const EarShape& ear : drawing.shape.ears) {
    drawing.sheet.Add(DrawnPart::kEars, faces::LineLabel::kEar, ear.outer);
    if (has_inner) drawing.sheet.Add(DrawnPart::kEars, faces::LineLabel::kEar, ear.inner).care = LineCare::kShort;
  }
}

void DrawSkin(const DrawingContext& drawing) {
  const HeadStyles& styles = drawing.styles.head;
  if (drawing.Happens(styles.wrinkles)) {
    const double share = drawing.Uniform(0.3, 1);
    for (const Polyline& wrinkle : drawing.shape.wrinkles)
      if (drawing.Happens(share)) drawing.sheet.Add(DrawnPart::kSkin, faces::LineLabel::kWrinkle, wrinkle);
  }
  if (drawing.Happens(styles.folds)) DrawFolds(drawing);
  if (drawing.Happens(styles.freckles)) DrawFreckles(drawing);
  if (drawing.Happens(styles.cheeks)) DrawCheeks(drawing);
}

}  // namespace daumier::datasets
