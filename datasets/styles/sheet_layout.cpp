#include "datasets/styles/sheet_layout.h"

#include "render/strokes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::datasets {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;

constexpr double kSheetSide = render::kSketchCanvas;

bool IsFace(DrawnPart part) {
  using enum DrawnPart;
  return part == kOutline || part == kEyeRight || part == kEyeLeft || part == kBrows || part == kNose || part == kMouth;
}

}  // namespace

render::Placement DrawSheetPose(const LineSheet& sheet, const PageStyles& page, Rng& rng) {
  render::Placement pose;
  const double most = page.greatest_turn;
  const double turn = Happens(0.2, rng) ? rng.Uniform(-most, most) : Deviate(page.turn_degrees, rng);
  pose.turn_degrees = page.turn_degrees > 0 ? std::clamp(turn, -most, most) : 0;
  const Eigen::Rotation2Dd rotation(pose.turn_degrees * std::numbers::pi / 180);
  AlignedBox2d all, face;
  for (const StyledLine& line : sheet.lines) {
    for (const Vector2d& point : line.points) {
      all.extend(rotation * point);
      if (IsFace(line.part)) face.extend(rotation * point);
    }
  }
  if (face.isEmpty()) face = all;
  AlignedBox2d shown = all;
  if (Happens(page.cropped, rng)) {  // Somewhere between the face and the whole.
    const double t = rng.Uniform(0, 0.8);
    shown = AlignedBox2d((1 - t) * face.min() + t * all.min(), (1 - t) * face.max() + t * all.max());
  }
  const double margin = rng.Uniform(3, 24);
  const double room = kSheetSide - 2 * margin;
  pose.scale = room / shown.sizes().cwiseMax(1).maxCoeff();
  const bool is_small = Happens(page.small, rng), is_off = Happens(page.off_centre, rng);
  if (is_small)
    pose.scale *= rng.Uniform(0.35, 0.8);
  else if (is_off)
    pose.scale *= rng.Uniform(0.7, 1);
  const Vector2d sizes = pose.scale * shown.sizes(), slack = (Vector2d::Constant(kSheetSide) - sizes).cwiseMax(0) / 2;
  Vector2d centre = Vector2d::Constant(kSheetSide / 2);
  const double roam = is_small || is_off ? 0.95 : 0.25;
  for (int axis = 0; axis < 2; ++axis) centre[axis] += roam * slack[axis] * rng.Uniform(-1, 1);
  Vector2d shift = centre - pose.scale * shown.center();
  // The face stays on the canvas.
  for (int axis = 0; axis < 2; ++axis) {
    const double low = pose.scale * face.min()[axis] + shift[axis], high = pose.scale * face.max()[axis] + shift[axis];
    if (low < 2) shift[axis] += 2 - low;
    if (high > kSheetSide - 2) shift[axis] -= high - (kSheetSide - 2);
  }
  pose.shift = shift;
  return pose;
}

}  // namespace daumier::datasets
