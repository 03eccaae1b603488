#include "datasets/styles/glasses_lines.h"

#include "datasets/styles/head_ring.h"

#include <cmath>
#include <numbers>

namespace daumier::datasets {
namespace {

using Eigen::Vector2d;

/// A lens from its top round and a little beyond: an oval, or a box with round corners.
Polyline LensLine(const Vector2d& middle, double half_x, double half_y, double squareness) {
  Polyline lens;
  constexpr int kPoints = 33;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = (-100 + 370.0 * i / (kPoints - 1)) * std::numbers::pi / 180;
    const double c = std::cos(angle), s = std::sin(angle), power = 2.0 / squareness;
    lens.push_back(middle + Vector2d(half_x * std::copysign(std::pow(std::abs(c), power), c),
                                     half_y * std::copysign(std::pow(std::abs(s), power), s)));
  }
  return lens;
}

}  // namespace

void DrawGlasses(const DrawingContext& drawing) {
  const FaceShape& shape = drawing.shape;
  if (!drawing.Happens(drawing.styles.extras.glasses)) return;
  if (shape.view == faces::DrawnView::kProfile || !shape.eyes[0].is_seen() || !shape.eyes[1].is_seen()) return;
  const auto add = [&](Polyline line) -> StyledLine& {
    return drawing.sheet.Add(DrawnPart::kGlasses, faces::LineLabel::kOther, std::move(line));
  };
  std::array<Vector2d, 2> middles;
  for (size_t side = 0; side < 2; ++side) {
    const EyeShape& eye = shape.eyes[side];
    middles[side] = (eye.upper.front() + eye.upper.back()) / 2;
  }
  const double span = (middles[1] - middles[0]).norm();
  const double half_x = span * drawing.Uniform(0.3, 0.45),
               squareness = drawing.Happens(0.5) ? 2 : drawing.Uniform(2.5, 5);
  const double half_y = half_x * drawing.Uniform(0.55, 1.05), drop = drawing.Uniform(0, 0.15) * half_y;
  const Vector2d across = (middles[1] - middles[0]) / span, down(0, drop);
  for (const Vector2d& middle : middles)
    add(LensLine(middle + down, half_x, half_y, squareness)).care = LineCare::kShort;
  const Vector2d right = middles[0] + half_x * across, left = middles[1] - half_x * across;
  const double arch = drawing.Uniform(0, 0.12) * span;
  add(Smooth({right, (right + left) / 2 - Vector2d(0, arch), left}, 7)).care = LineCare::kShort;
  if (!drawing.Happens(0.7)) return;
  const HeadRing ring(shape);
  for (size_t side = 0; side < 2; ++side) {
    const double outward = side == 0 ? -1 : 1;
    const Vector2d from = middles[side] + outward * half_x * across, border = ring.At(outward * 88, 1.0);
    if (outward * (border - from).x() > 0.05 * span) add({from, (from + border) / 2, border});
  }
}

}  // namespace daumier::datasets
