#include "datasets/styles/bust_lines.h"

#include <algorithm>
#include <cmath>

namespace daumier::datasets {
namespace {

using Eigen::Vector2d;

StyledLine& AddBustLine(const DrawingContext& drawing, faces::LineLabel label, Polyline line) {
  return drawing.sheet.Add(DrawnPart::kBust, label, std::move(line));
}

/// The ends of the neck's sides at the shoulders, right and left.
struct NeckLines {
  std::array<Vector2d, 2> ends;
};

NeckLines DrawNeck(const DrawingContext& drawing) {
  const FaceShape& shape = drawing.shape;
  const double u = drawing.unit(), length = drawing.Uniform(0.25, 0.75) * u;
  const Vector2d chin = shape.outline[size_t(shape.chin)];
  NeckLines neck;
  if (shape.view == faces::DrawnView::kProfile) {
    const Vector2d nape = shape.skull.front(), throat = shape.outline.back();
    neck.ends = {nape + Vector2d(-drawing.Uniform(0, 0.15) * u, length),
                 throat + Vector2d(drawing.Uniform(-0.1, 0.15) * u, length)};
    AddBustLine(drawing, faces::LineLabel::kNeck,
                Smooth({nape, nape + Vector2d(0.05 * u, 0.5 * length), neck.ends[0]}, 11));
    AddBustLine(drawing, faces::LineLabel::kNeck, Smooth({throat, 0.5 * (throat + neck.ends[1]), neck.ends[1]}, 11));
    return neck;
  }
  const double inset = drawing.Uniform(0.18, 0.36), flare = drawing.Uniform(-0.02, 0.15) * u;
  for (size_t side = 0; side < 2; ++side) {
    const double outward = side == 0 ? -1 : 1;
    const Vector2d jaw = AtShare(shape.outline, side == 0 ? inset : 1 - inset);
    // Begins inside the head, which covers its beginning.
    const Vector2d from(chin.x() + 0.92 * (jaw.x() - chin.x()), jaw.y() - 0.1 * u);
    const double bottom = chin.y() + length;
    neck.ends[side] = {from.x() + outward * flare, bottom};
    const double waist = drawing.Uniform(-0.04, 0.03) * u;
    AddBustLine(drawing, faces::LineLabel::kNeck,
                Smooth({from, {from.x() + outward * waist, 0.5 * (from.y() + bottom)}, neck.ends[side]}, 15));
  }
  return neck;
}

/// From the neck's ends outward and down; in one line with the neck at times.
void DrawShoulders(const DrawingContext& drawing, const NeckLines& neck) {
  const double u = drawing.unit(), width = drawing.Uniform(0.5, 1.4) * u, slope = drawing.Uniform(0.1, 0.45),
               round = drawing.Uniform(0, 0.4) * u;
  const double arm = drawing.Happens(0.5) ? drawing.Uniform(0.1, 0.8) * u : 0;
  for (size_t side = 0; side < 2; ++side) {
    const double outward = side == 0 ? -1 : 1, w = width * drawing.Uniform(0.9, 1.1);
    const Vector2d from = neck.ends[side], edge = from + Vector2d(outward * w, slope * w);
    Polyline through = {from, from + Vector2d(outward * 0.35 * w, 0.22 * slope * w),
                        edge - Vector2d(outward * 0.1 * w, 0.2 * round)};
    if (arm > 0) through.push_back(edge + Vector2d(outward * 0.1 * arm, 0.3 * arm));
    through.push_back(edge + Vector2d(outward * 0.2 * arm, arm));
    AddBustLine(drawing, faces::LineLabel::kNeck, Smooth(through, 21));
  }
}

void DrawCollar(const DrawingContext& drawing, const NeckLines& neck) {
  const double u = drawing.unit();
  const auto& [right, left] = neck.ends;
  const Vector2d middle = (right + left) / 2;
  const double half = (left - right).norm() / 2;
  const auto add = [&](Polyline line) { AddBustLine(drawing, faces::LineLabel::kOther, std::move(line)); };
  switch (drawing.Count(0, 3)) {
    case 0: {  // A round neckline, once or twice.
      const double deep = drawing.Uniform(0.1, 0.4) * u, wide = half * drawing.Uniform(1.05, 1.4);
      add(Smooth({middle + Vector2d(-wide, 0), middle + Vector2d(0, deep), middle + Vector2d(wide, 0)}, 13));
      if (drawing.Happens(0.5))
        add(Smooth({middle + Vector2d(-wide - 0.06 * u, 0.02 * u), middle + Vector2d(0, deep + 0.09 * u),
                    middle + Vector2d(wide + 0.06 * u, 0.02 * u)},
                   13));
      return;
    }
    case 1: {  // A V.
      const Vector2d point = middle + Vector2d(Deviate(0.05 * u, drawing.rng), drawing.Uniform(0.3, 0.8) * u);
      add({right, (right + point) / 2, point});
      add({left, (left + point) / 2, point});
      return;
    }
    default: {  // A shirt, perhaps with a tie.
      const Vector2d knot = middle + Vector2d(0, drawing.Uniform(0.15, 0.3) * u);
      for (const double side : {-1.0, 1.0}) {
        const Vector2d top = side < 0 ? right : left,
                       flap = top + Vector2d(-side * 0.15 * half, drawing.Uniform(0.25, 0.4) * u);
        add({top, knot, flap, top + Vector2d(side * 0.12 * half, 0.1 * u)});
      }
      if (drawing.Happens(0.5)) return;
      const double w = drawing.Uniform(0.05, 0.09) * u, length = drawing.Uniform(0.4, 0.9) * u;
      add({knot + Vector2d(-w, 0), knot + Vector2d(w, 0), knot + Vector2d(0.7 * w, 1.6 * w),
           knot + Vector2d(-0.7 * w, 1.6 * w), knot + Vector2d(-w, 0)});
      add({knot + Vector2d(-0.7 * w, 1.6 * w), knot + Vector2d(-1.4 * w, length), knot + Vector2d(0, length + w),
           knot + Vector2d(1.4 * w, length), knot + Vector2d(0.7 * w, 1.6 * w)});
    }
  }
}

}  // namespace

void DrawBust(const DrawingContext& drawing) {
  const ExtraStyles& styles = drawing.styles.extras;
  if (!drawing.Happens(styles.neck)) return;
  LineSheet& sheet = drawing.sheet;
  const size_t begin = sheet.lines.size();
  const NeckLines neck = DrawNeck(drawing);
  if (drawing.Happens(styles.shoulders)) {
    DrawShoulders(drawing, neck);
    if (drawing.shape.view != faces::DrawnView::kProfile && drawing.Happens(styles.collar)) DrawCollar(drawing, neck);
  }
  sheet.CutInside(drawing.shape.head(), begin, sheet.lines.size());
}

void DrawEarrings(const DrawingContext& drawing) {
  if (!drawing.Happens(drawing.styles.extras.earrings)) return;
  const double u = drawing.unit(), size = drawing.Uniform(0.03, 0.1) * u;
  const bool hangs = drawing.Happens(0.5);
  const std::vector<StyledLine> lines = drawing.sheet.lines;
  for (const StyledLine& line : lines) {
    if (line.part != DrawnPart::kEars || LengthOf(line.points) < 0.2 * u) continue;
    const Vector2d lobe = *std::max_element(line.points.begin(), line.points.end(),
                                            [](const Vector2d& a, const Vector2d& b) { return a.y() < b.y(); });
    const Vector2d middle = lobe + Vector2d(0, hangs ? 2.2 * size : 0.4 * size);
    if (hangs)
      drawing.sheet.AddMark(DrawnPart::kEars, faces::LineLabel::kOther, {lobe, middle - Vector2d(0, 1.4 * size)});
    drawing.sheet
        .Add(DrawnPart::kEars, faces::LineLabel::kOther,
             EllipseArc(middle, size, hangs ? 1.4 * size : size, -90, 275, 13))
        .care = LineCare::kShort;
  }
}

}  // namespace daumier::datasets
