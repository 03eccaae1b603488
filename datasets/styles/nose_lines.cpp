#include "datasets/styles/nose_lines.h"

#include <algorithm>

namespace daumier::datasets {
namespace {

using Eigen::Vector2d;
using enum faces::FacePoint;

faces::FacePoint WingPoint(size_t side) {
  return side == 0 ? kNoseWingRight : kNoseWingLeft;
}

/// Outward along x: -1 on the right side.
double OutwardOf(size_t side) {
  return side == 0 ? -1 : 1;
}

/// The index of the outermost point of a line.
int Outermost(const Polyline& line, size_t side) {
  const double outward = OutwardOf(side);
  const auto outer = std::max_element(line.begin(), line.end(), [&](const Vector2d& a, const Vector2d& b) {
    return outward * a.x() < outward * b.x();
  });
  return static_cast<int>(outer - line.begin());
}

StyledLine& AddNoseLine(const DrawingContext& drawing, Polyline line, std::vector<LineAnchor> anchors = {}) {
  return drawing.sheet.Add(DrawnPart::kNose, faces::LineLabel::kNose, std::move(line), std::move(anchors));
}

/// Where the side of the nose that is drawn comes down: the bridge, or the contour of a turned face's far side.
const Polyline& BridgeOf(const NoseShape& nose, size_t side) {
  return nose.bridges[side].empty() && !nose.contour.empty() ? nose.contour : nose.bridges[side];
}

/// A side of the nose: down the bridge from a share of its length, and round the wing.
Polyline SideLine(const NoseShape& nose, size_t side, double from, bool has_wing) {
  const Polyline& bridge = BridgeOf(nose, side);
  if (bridge.empty()) return {};
  Polyline through = Part(bridge, from, 1, 5);
  if (&bridge == &nose.contour || !has_wing || nose.wings[side].empty()) return Smooth(through, 15);
  through.pop_back();
  for (const double share : {0.0, 0.35, 0.7, 1.0}) through.push_back(AtShare(nose.wings[side], share));
  return Smooth(through, 21);
}

void DrawBase(const DrawingContext& drawing, double from, double to) {
  const Polyline& base = drawing.shape.nose.base;
  constexpr int kLastIndex = NoseShape::kBasePoints - 1;
  const auto first = static_cast<int>(from * kLastIndex + 0.5), last = static_cast<int>(to * kLastIndex + 0.5);
  std::vector<LineAnchor> anchors;
  if (first <= NoseShape::kBaseMiddle && last >= NoseShape::kBaseMiddle)
    anchors.push_back({kNoseBottom, NoseShape::kBaseMiddle - first});
  AddNoseLine(drawing, Polyline(base.begin() + first, base.begin() + last + 1), anchors);
}

void DrawSide(const DrawingContext& drawing, size_t side, double from) {
  Polyline line = SideLine(drawing.shape.nose, side, from, true);
  if (line.empty()) return;
  const bool has_wing = !drawing.shape.nose.wings[side].empty();
  const int outermost = Outermost(line, side);
  AddNoseLine(drawing, std::move(line),
              has_wing ? std::vector<LineAnchor>{{WingPoint(side), outermost}} : std::vector<LineAnchor>{});
}

void DrawWing(const DrawingContext& drawing, size_t side) {
  const Polyline& wing = drawing.shape.nose.wings[side];
  if (wing.empty()) return;
  const Polyline line = Part(wing, drawing.Uniform(0, 0.3), 1, NoseShape::kWingPoints);
  AddNoseLine(drawing, line, {{WingPoint(side), Outermost(line, side)}});
}

void DrawNostrils(const DrawingContext& drawing, bool as_dots) {
  const Polyline& base = drawing.shape.nose.base;
  const double size = drawing.Uniform(0.02, 0.05) * drawing.unit(), bend = drawing.Uniform(-1, 1);
  for (const double share : {0.22, 0.78}) {
    const Vector2d centre = AtShare(base, share) - Vector2d(0, 0.4 * size);
    if (as_dots) {
      StyledLine& dot = drawing.sheet.AddMark(DrawnPart::kNose, faces::LineLabel::kNose,
                                              EllipseArc(centre, size, 0.7 * size, 0, 360, 9));
      dot.filled = drawing.Happens(0.7);
    } else {
      const double side = share < 0.5 ? -1 : 1;
      AddNoseLine(drawing, Smooth({centre + Vector2d(-1.6 * size, side * bend * size), centre - Vector2d(0, size),
                                   centre + Vector2d(1.6 * size, -side * bend * size)},
                                  7))
          .care = LineCare::kShort;
    }
  }
}

/// A line down and to the other side: an L.
void DrawHook(const DrawingContext& drawing, size_t side) {
  const NoseShape& nose = drawing.shape.nose;
  const Polyline& bridge = BridgeOf(nose, side).empty() ? BridgeOf(nose, 1 - side) : BridgeOf(nose, side);
  if (bridge.empty()) return;
  const double outward = OutwardOf(side);
  const Vector2d bottom = nose.base[NoseShape::kBaseMiddle];
  const double reach = 0.5 * (nose.base.front() - nose.base.back()).norm();
  const Vector2d top = AtShare(bridge, drawing.Uniform(0, 0.5));
  const Vector2d corner =
      bottom + Vector2d(outward * reach * drawing.Uniform(0.4, 1.2), -reach * drawing.Uniform(0, 0.4));
  const Vector2d end =
      bottom + Vector2d(-outward * reach * drawing.Uniform(0.1, 1.0), -reach * drawing.Uniform(-0.05, 0.5));
  Polyline line;
  if (drawing.Happens(0.5)) {  // With a sharp corner, which is the bottom.
    const Vector2d low = bottom + Vector2d(outward * reach * drawing.Uniform(0, 0.6), 0);
    const Polyline down = Resampled({top, low}, 9);
    line = Joined(down, Part({low, end}, 0.15, 1, 7));
    AddNoseLine(drawing, line, {{kNoseBottom, 8}});
    return;
  }
  line = Smooth({top, 0.6 * corner + 0.4 * top + Vector2d(-outward * 0.15 * reach, 0), corner, bottom, end}, 21);
  const int lowest = NearestIndex(line, bottom);
  AddNoseLine(drawing, line, {{kNoseBottom, lowest}});
}

/// A rounded or pointed outline of the tip.
void DrawRound(const DrawingContext& drawing) {
  const NoseShape& nose = drawing.shape.nose;
  const Vector2d bottom = nose.base[NoseShape::kBaseMiddle];
  const double half = 0.5 * (nose.base.front() - nose.base.back()).norm() * drawing.Uniform(0.7, 1.3);
  const double height = half * drawing.Uniform(0.6, 2.2);
  const bool is_oval = drawing.Happens(0.35);
  const Vector2d middle = bottom - Vector2d(0, is_oval ? height : 0.4 * height);
  if (is_oval) {
    AddNoseLine(drawing, EllipseArc(middle, half, height, -90, 270, 25),
                {{kNoseBottom, 12}, {kNoseWingLeft, 6}, {kNoseWingRight, 18}});
  } else if (drawing.Happens(0.5)) {
    Polyline arc = EllipseArc(middle, half, 0.4 * height, -drawing.Uniform(10, 70), 180 + drawing.Uniform(10, 70), 21);
    const int left = Outermost(arc, 1), right = Outermost(arc, 0);
    AddNoseLine(drawing, std::move(arc), {{kNoseBottom, 10}, {kNoseWingLeft, left}, {kNoseWingRight, right}});
  } else {
    const Vector2d apex = bottom + Vector2d(drawing.Uniform(-0.3, 0.3) * half, -1.6 * height);
    const Vector2d right = bottom - Vector2d(half, 0), left = bottom + Vector2d(half, 0);
    Polyline line = Joined(Resampled({apex, right}, 7), Part({right, left}, 0.12, 1, 9));
    if (drawing.Happens(0.7)) line = Joined(std::move(line), Part({left, apex}, 0.15, 1, 6));
    AddNoseLine(drawing, std::move(line), {{kNoseBottom, 10}, {kNoseWingRight, 6}, {kNoseWingLeft, 15}});
  }
}

void DrawProfileNose(const DrawingContext& drawing) {
  if (drawing.Happens(0.8)) DrawWing(drawing, 0);
  if (!drawing.shape.nose.base.empty() && drawing.Happens(0.6)) AddNoseLine(drawing, drawing.shape.nose.base);
}

}  // namespace

void DrawNose(const DrawingContext& drawing) {
  const NoseStyles& styles = drawing.styles.nose;
  const NoseShape& nose = drawing.shape.nose;
  if (drawing.Happens(styles.none)) return;
  if (drawing.shape.view == faces::DrawnView::kProfile) return DrawProfileNose(drawing);
  if (nose.base.empty()) return;
  // A turned face shows the far side's contour.
  size_t side = drawing.rng.Below(2);
  if (drawing.shape.view == faces::DrawnView::kThreeQuarterLeft) side = 0;
  if (drawing.shape.view == faces::DrawnView::kThreeQuarterRight) side = 1;
  const double from = drawing.Happens(0.5) ? drawing.Uniform(0, 0.25) : drawing.Uniform(0.25, 0.75);
  switch (DrawByWeight<8>({styles.one_side, styles.both_sides, styles.wings, styles.nostrils, styles.hook,
                           styles.bridge, styles.round, styles.dot},
                          drawing.rng)) {
    case 0:
      DrawSide(drawing, side, from);
      DrawBase(drawing, side == 0 ? 0 : drawing.Uniform(0, 0.5), side == 0 ? drawing.Uniform(0.5, 1) : 1);
      if (drawing.Happens(0.6)) DrawWing(drawing, 1 - side);
      break;
    case 1:
      DrawSide(drawing, 0, from);
      DrawSide(drawing, 1, drawing.Happens(0.6) ? from : drawing.Uniform(0, 0.7));
      if (drawing.Happens(0.85)) DrawBase(drawing, 0, 1);
      if (drawing.Happens(0.15)) DrawNostrils(drawing, true);
      break;
    case 2:
      DrawWing(drawing, 0);
      DrawWing(drawing, 1);
      if (drawing.Happens(0.8))
        DrawBase(drawing, drawing.Uniform(0, 0.3), drawing.Uniform(0.7, 1));
      else
        DrawNostrils(drawing, drawing.Happens(0.6));
      break;
    case 3:
      DrawNostrils(drawing, drawing.Happens(0.6));
      break;
    case 4:
      DrawHook(drawing, side);
      break;
    case 5: {
      const Polyline line = SideLine(nose, side, from, false);
      if (line.empty())
        DrawBase(drawing, 0, 1);
      else
        AddNoseLine(drawing, line);
      break;
    }
    case 6:
      DrawRound(drawing);
      break;
    default: {
      const double size = drawing.Uniform(0.015, 0.05) * drawing.unit();
      StyledLine& dot = drawing.sheet.AddMark(DrawnPart::kNose, faces::LineLabel::kNose,
                                              EllipseArc(nose.base[NoseShape::kBaseMiddle], size, size, 90, 450, 9));
      dot.anchors = {{kNoseBottom, 0}};
      dot.filled = drawing.Happens(0.6);
    }
  }
}

}  // namespace daumier::datasets
