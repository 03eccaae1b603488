#include "datasets/styles/hat_lines.h"

#include "datasets/styles/head_ring.h"

#include <cmath>
#include <numbers>

namespace daumier::datasets {
namespace {

using Eigen::Vector2d;

StyledLine& AddHat(const DrawingContext& drawing, Polyline line) {
  return drawing.sheet.Add(DrawnPart::kHat, faces::LineLabel::kOther, std::move(line));
}

/// The lower border of a hat across the forehead, from right to left.
Polyline HatBorder(const HeadRing& ring, double angle, double share, double sag) {
  const Vector2d right = ring.At(-angle, 1.06), left = ring.At(angle, 1.06);
  const Vector2d middle(ring.middle().x(), ring.middle().y() - share * ring.Radius(0) + sag);
  return Smooth({right, 0.5 * (right + middle) + Vector2d(0, 0.3 * sag), middle,
                 0.5 * (left + middle) + Vector2d(0, 0.3 * sag), left},
                21);
}

}  // namespace

void DrawHat(const DrawingContext& drawing) {
  if (!drawing.Happens(drawing.styles.extras.hat) || drawing.shape.view == faces::DrawnView::kProfile) return;
  const HeadRing ring(drawing.shape);
  LineSheet& sheet = drawing.sheet;
  const double r = ring.Radius(0), angle = drawing.Uniform(62, 84), share = drawing.Uniform(0.42, 0.62);
  const double sag = drawing.Uniform(-0.1, 0.12) * r;
  const Polyline border = HatBorder(ring, angle, share, sag);
  const size_t kind = DrawByWeight<5>({2, 2, 2, 1, 0.7}, drawing.rng);
  Polyline crown;   // From the left end of the border to the right one.
  if (kind == 3) {  // Straight up.
    const double high = drawing.Uniform(0.9, 1.7) * r, lean = drawing.Uniform(-0.1, 0.1) * r,
                 taper = drawing.Uniform(-0.1, 0.15) * r;
    const Vector2d left = border.back() + Vector2d(lean - taper, -high),
                   right = border.front() + Vector2d(lean + taper, -high);
    crown = Joined(Resampled({border.back(), left}, 9),
                   Joined(Smooth({left, 0.5 * (left + right) - Vector2d(0, 0.05 * r), right}, 9),
                          Resampled({right, border.front()}, 9)));
  } else if (kind == 4) {
    const Vector2d peak = ring.At(Deviate(12, drawing.rng), drawing.Uniform(1.7, 2.4));
    crown = Joined(Resampled({border.back(), peak}, 9), Resampled({peak, border.front()}, 9));
  } else {
    const double high = drawing.Uniform(1.08, 1.35), bump = drawing.Uniform(-0.05, 0.1);
    crown = ring.Arc(angle, -angle, 31, [&](double t) {
      return 1.06 + (high - 1.06) * std::sin(std::numbers::pi * t) + bump * std::sin(2 * std::numbers::pi * t) * 0.5;
    });
  }
  sheet.CutInside(Joined(border, crown), 0, sheet.lines.size());
  AddHat(drawing, crown);
  AddHat(drawing, border);
  const double width = (border.front() - border.back()).norm();
  const Vector2d middle = (border.front() + border.back()) / 2;
  switch (kind) {
    case 0: {  // The peak of a cap, to the front or to a side.
      const double lean = drawing.Uniform(-0.4, 0.4) * width, drop = drawing.Uniform(0.05, 0.22) * width;
      const Vector2d low = middle + Vector2d(lean, drop + sag);
      const Polyline peak = Smooth({AtShare(border, 0.08), low - Vector2d(0.3 * width, 0.3 * drop), low,
                                    low + Vector2d(0.3 * width, -0.3 * drop), AtShare(border, 0.92)},
                                   21);
      sheet.CutInside(Joined(border, Reversed(peak)), 0, sheet.lines.size() - 2);
      AddHat(drawing, peak);
      break;
    }
    case 1:
    case 3: {  // A brim all round.
      const double half = width * drawing.Uniform(0.62, 0.85), high = drawing.Uniform(0.04, 0.12) * width;
      const Polyline brim = EllipseArc(middle + Vector2d(0, 0.3 * high), half, high, -170, 190, 41);
      sheet.CutInside(brim, 0, sheet.lines.size() - 2);
      sheet.CutInside(brim, sheet.lines.size() - 1, sheet.lines.size());
      AddHat(drawing, brim);
      break;
    }
    case 2: {  // The roll of a beanie, and ribs.
      const double high = drawing.Uniform(0.12, 0.25) * r;
      Polyline roll = border;
      for (Vector2d& point : roll) point.y() -= high;
      AddHat(drawing, roll);
      if (drawing.Happens(0.5)) {
        const int count = drawing.Count(6, 16);
        for (int i = 1; i < count; ++i)
          sheet.AddMark(DrawnPart::kHat, faces::LineLabel::kOther,
                        {AtShare(border, double(i) / count), AtShare(roll, double(i) / count)});
      }
      if (drawing.Happens(0.4)) {
        const double size = drawing.Uniform(0.1, 0.2) * r;
        AddHat(drawing, EllipseArc(ring.At(0, 1.25), size, size, 100, 470, 17)).care = LineCare::kShort;
      }
      break;
    }
    default:
      break;
  }
}

}  // namespace daumier::datasets
