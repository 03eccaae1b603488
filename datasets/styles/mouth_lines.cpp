#include "datasets/styles/mouth_lines.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::datasets {
namespace {

using Eigen::Vector2d;
using enum faces::FacePoint;

constexpr int kLastOfMouth = MouthShape::kPoints - 1;

/// The corners among the anchors of a line along the lips.
std::vector<LineAnchor> WithCorners(const MouthShape& mouth, std::vector<LineAnchor> anchors) {
  anchors.push_back({kMouthRight, 0});
  if (mouth.middle != kLastOfMouth) anchors.push_back({kMouthLeft, kLastOfMouth});
  return anchors;
}

void DrawUpperLip(const DrawingContext& drawing, const MouthShape& mouth) {
  drawing.sheet.Add(DrawnPart::kMouth, faces::LineLabel::kUpperLip, mouth.top,
                    WithCorners(mouth, {{kLipTop, mouth.middle}}));
}

void DrawLowerLip(const DrawingContext& drawing, const MouthShape& mouth) {
  drawing.sheet.Add(DrawnPart::kMouth, faces::LineLabel::kLowerLip, mouth.bottom,
                    WithCorners(mouth, {{kLipBottom, mouth.middle}}));
}

/// Both lips in one go, round the mouth.
void DrawBothLips(const DrawingContext& drawing, const MouthShape& mouth) {
  if (mouth.middle == kLastOfMouth || drawing.Happens(0.5)) {
    DrawUpperLip(drawing, mouth);
    DrawLowerLip(drawing, mouth);
    return;
  }
  const Polyline bottom = Reversed(mouth.bottom);
  Polyline loop = mouth.top;
  loop.insert(loop.end(), bottom.begin() + 1, bottom.end());
  StyledLine& line = drawing.sheet.Add(
      DrawnPart::kMouth, faces::LineLabel::kUpperLip, std::move(loop),
      WithCorners(mouth, {{kLipTop, mouth.middle}, {kLipBottom, kLastOfMouth + kLastOfMouth - mouth.middle}}));
  std::fill(line.labels.begin() + kLastOfMouth, line.labels.end(), faces::LineLabel::kLowerLip);
}

Polyline SeamOf(const MouthShape& mouth) {
  Polyline seam = Mixed(mouth.inner_top, mouth.inner_bottom, 0.5);
  seam.front() = mouth.top.front();
  if (mouth.middle != kLastOfMouth) seam.back() = mouth.top.back();
  return seam;
}

void DrawSeam(const DrawingContext& drawing, const MouthShape& mouth) {
  drawing.sheet.Add(DrawnPart::kMouth, faces::LineLabel::kInnerMouth, SeamOf(mouth),
                    WithCorners(mouth, {{kInnerTop, mouth.middle}, {kInnerBottom, mouth.middle}}));
}

/// Small lines that hint at lips: below the lower one, and at the corners.
void DrawHints(const DrawingContext& drawing, const MouthShape& mouth) {
  const Vector2d down(0, 1);
  if (drawing.Happens(0.4)) {
    const double half = drawing.Uniform(0.1, 0.25);
    Polyline mark = Part(mouth.bottom, 0.5 - half, 0.5 + half, 7);
    const double shift = drawing.Uniform(-0.02, 0.05) * drawing.unit();
    for (Vector2d& point : mark) point += shift * down;
    drawing.sheet.Add(DrawnPart::kSkin, faces::LineLabel::kWrinkle, mark);
  }
  if (!drawing.Happens(0.15)) return;
  const double size = drawing.Uniform(0.03, 0.08) * drawing.unit();
  for (const Vector2d& corner : {mouth.top.front(), mouth.top.back()}) {
    const double lean = drawing.Uniform(-0.4, 0.4) * size;
    drawing.sheet.Add(
        DrawnPart::kSkin, faces::LineLabel::kWrinkle,
        Smooth({corner + Vector2d(lean, -size), corner + Vector2d(-lean / 2, 0), corner + Vector2d(lean, size)}, 5));
  }
}

void DrawClosed(const DrawingContext& drawing, const MouthShape& mouth) {
  const MouthStyles& styles = drawing.styles.mouth;
  drawing.sheet.mouth = faces::MouthState::kClosed;
  switch (DrawByWeight<4>({styles.outline_and_middle, styles.outline, styles.middle, styles.upper_and_middle},
                          drawing.rng)) {
    case 0:
      DrawBothLips(drawing, mouth);
      return DrawSeam(drawing, mouth);
    case 1:
      return DrawBothLips(drawing, mouth);
    case 2:
      DrawSeam(drawing, mouth);
      if (drawing.character != DrawingCharacter::kDoodle) DrawHints(drawing, mouth);
      return;
    default:
      DrawUpperLip(drawing, mouth);
      DrawSeam(drawing, mouth);
      if (drawing.Happens(0.5)) DrawHints(drawing, mouth);
  }
}

/// The lower edge of the opening and the lower lip moved down.
MouthShape Opened(MouthShape mouth, double depth) {
  const Polyline seam = SeamOf(mouth);
  const bool is_profile = mouth.middle == kLastOfMouth;
  for (int i = 0; i <= kLastOfMouth; ++i) {
    const double share = double(i) / kLastOfMouth;
    const double bulge = is_profile ? share : std::sin(std::numbers::pi * share);
    const auto k = static_cast<size_t>(i);
    mouth.inner_top[k] = seam[k] - Vector2d(0, 0.1 * depth * bulge);
    mouth.inner_bottom[k] = seam[k] + Vector2d(0, depth * bulge);
    mouth.bottom[k] += Vector2d(0, depth * bulge);
  }
  return mouth;
}

/// The lips together, as thick as they are.
MouthShape Closed(MouthShape mouth) {
  const Polyline seam = SeamOf(mouth);
  for (size_t k = 0; k < seam.size(); ++k) {
    mouth.top[k] += seam[k] - mouth.inner_top[k];
    mouth.bottom[k] += seam[k] - mouth.inner_bottom[k];
  }
  mouth.top.front() = mouth.bottom.front() = seam.front();
  if (mouth.middle != kLastOfMouth) mouth.top.back() = mouth.bottom.back() = seam.back();
  mouth.inner_top = mouth.inner_bottom = seam;
  return mouth;
}

void DrawTeeth(const DrawingContext& drawing, const MouthShape& mouth) {
  LineSheet& sheet = drawing.sheet;
  const Polyline &top = mouth.inner_top, &bottom = mouth.inner_bottom;
  // 0: a band of upper teeth, 1: with gaps between them, 2: teeth over the whole height, 3: a grid.
  const size_t kind = DrawByWeight<4>({4, 2, 2, 1.5}, drawing.rng);
  double low = kind == 2 ? 1 : drawing.Uniform(0.3, 0.65);
  if (kind == 3) low = 0.5;
  const Polyline edge = Mixed(top, bottom, low);
  if (kind != 2) {
    const double inset = drawing.Uniform(0.02, 0.12);
    sheet.Add(DrawnPart::kMouth, faces::LineLabel::kInnerMouth, Part(edge, inset, 1 - inset, 11));
  }
  if (kind == 0) return;
  const int count = drawing.Count(3, 8);
  for (int i = 1; i <= count; ++i) {
    const double share = (i + drawing.Uniform(-0.15, 0.15)) / (count + 1);
    const Vector2d from = AtShare(top, share), to = AtShare(kind == 3 ? bottom : edge, share);
    sheet.AddMark(DrawnPart::kMouth, faces::LineLabel::kInnerMouth, {from, (from + to) / 2, to});
  }
}

void DrawTongue(const DrawingContext& drawing, const MouthShape& mouth) {
  const double half = drawing.Uniform(0.15, 0.3), middle = drawing.Uniform(0.42, 0.58);
  const double height = drawing.Uniform(0.35, 0.65);
  const Vector2d from = AtShare(mouth.inner_bottom, middle - half), to = AtShare(mouth.inner_bottom, middle + half);
  const Vector2d peak = (1 - height) * AtShare(mouth.inner_bottom, middle) + height * AtShare(mouth.inner_top, middle);
  drawing.sheet
      .Add(DrawnPart::kMouth, faces::LineLabel::kInnerMouth,
           Smooth({from, (from + 2 * peak) / 3, peak, (to + 2 * peak) / 3, to}, 11))
      .care = LineCare::kShort;
}

void DrawOpening(const DrawingContext& drawing, const MouthShape& mouth, LineCare care) {
  const bool is_profile = mouth.middle == kLastOfMouth;
  if (is_profile || drawing.Happens(0.5)) {
    drawing.sheet
        .Add(DrawnPart::kMouth, faces::LineLabel::kInnerMouth, mouth.inner_top,
             WithCorners(mouth, {{kInnerTop, mouth.middle}}))
        .care = care;
    drawing.sheet
        .Add(DrawnPart::kMouth, faces::LineLabel::kInnerMouth, mouth.inner_bottom,
             WithCorners(mouth, {{kInnerBottom, mouth.middle}}))
        .care = care;
    return;
  }
  const Polyline bottom = Reversed(mouth.inner_bottom);
  Polyline loop = mouth.inner_top;
  loop.insert(loop.end(), bottom.begin() + 1, bottom.end());
  StyledLine& line = drawing.sheet.Add(
      DrawnPart::kMouth, faces::LineLabel::kInnerMouth, std::move(loop),
      WithCorners(mouth, {{kInnerTop, mouth.middle}, {kInnerBottom, kLastOfMouth + kLastOfMouth - mouth.middle}}));
  line.care = care;
}

void DrawOpen(const DrawingContext& drawing, MouthShape mouth) {
  const MouthStyles& styles = drawing.styles.mouth;
  const bool has_lips = DrawByWeight<2>({styles.lips_and_opening, styles.opening}, drawing.rng) == 0;
  for (Polyline* inner : {&mouth.inner_top, &mouth.inner_bottom}) {
    const double t = has_lips ? 0.7 : 1;  // The opening's corners are near those of the lips.
    inner->front() += t * (mouth.top.front() - inner->front());
    if (mouth.middle != kLastOfMouth) inner->back() += t * (mouth.top.back() - inner->back());
  }
  if (has_lips) DrawBothLips(drawing, mouth);
  DrawOpening(drawing, mouth, LineCare::kFree);
  // The corners are those of the lips where there are lips.
  if (has_lips) {
    for (StyledLine& line : drawing.sheet.lines) {
      if (line.part != DrawnPart::kMouth || line.labels.front() != faces::LineLabel::kInnerMouth) continue;
      std::erase_if(line.anchors, [](const LineAnchor& a) { return a.point == kMouthRight || a.point == kMouthLeft; });
    }
  }
  drawing.sheet.mouth = faces::MouthState::kOpen;
  const size_t m = static_cast<size_t>(mouth.middle);
  const double gap = mouth.inner_bottom[m].y() - mouth.inner_top[m].y();
  if (drawing.Happens(styles.teeth) && gap > 0.04 * drawing.unit()) {
    drawing.sheet.mouth = faces::MouthState::kTeeth;
    DrawTeeth(drawing, mouth);
  } else if (drawing.Happens(styles.tongue) && gap > 0.1 * drawing.unit()) {
    DrawTongue(drawing, mouth);
  } else if (drawing.Happens(0.08)) {
    StyledLine& dark = drawing.sheet.AddMark(DrawnPart::kMouth, faces::LineLabel::kInnerMouth,
                                             Joined(mouth.inner_top, Reversed(mouth.inner_bottom)));
    dark.filled = true;
  }
}

}  // namespace

void DrawMouth(const DrawingContext& drawing) {
  const MouthShape& mouth = drawing.shape.mouth;
  if (mouth.top.empty() || drawing.Happens(drawing.styles.mouth.none)) return;
  if (mouth.is_open) {
    if (drawing.Happens(drawing.styles.mouth.closed)) return DrawClosed(drawing, Closed(mouth));
    return DrawOpen(drawing, mouth);
  }
  if (drawing.Happens(drawing.styles.mouth.opened))
    return DrawOpen(drawing, Opened(mouth, drawing.Uniform(0.07, 0.3) * drawing.unit()));
  DrawClosed(drawing, mouth);
}

}  // namespace daumier::datasets
