#include "datasets/read/augmentation.h"

#include "datasets/read/pen_effects.h"
#include "datasets/read/stroke_arc.h"
#include "datasets/read/stroke_deformation.h"
#include "datasets/read/stroke_removal.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace daumier::datasets {
namespace {

using render::Stroke;

constexpr double kCanvas = render::kSketchCanvas;
/// 10 of 800 pixels [Yu et al. 2016].
constexpr double kMargin = 10.0 * kCanvas / 800;
/// Length in pixels over which the two lines of a retraced stroke come apart and together again.
constexpr double kRetraceLength = 64;

AugmentationOptions TimesStrength(AugmentationOptions options) {
  for (double* effect : {&options.removal, &options.stroke_shift_px, &options.drawing_shift_px, &options.width,
                         &options.retrace, &options.retrace_px, &options.tremor_px, &options.gaps, &options.shift_px,
                         &options.scale, &options.rotation_degrees})
    *effect *= options.strength;
  return options;
}

Eigen::AlignedBox2d Bounds(const std::vector<Stroke>& strokes) {
  Eigen::AlignedBox2d box;
  for (const Stroke& stroke : strokes)
    for (const auto& point : stroke.points) box.extend(ToVector(point));
  return box;
}

std::vector<Stroke> Transformed(std::vector<Stroke> strokes, const Eigen::Affine2d& transform) {
  for (Stroke& stroke : strokes)
    for (auto& point : stroke.points) point = ToPoint(transform * ToVector(point));
  return strokes;
}

/// Turned and scaled about the middle of the canvas, then shifted.
Eigen::Affine2d DrawPlacement(const AugmentationOptions& options, Rng& rng) {
  const double angle = options.rotation_degrees * rng.Uniform(-1, 1) * std::numbers::pi / 180;
  const double factor = std::exp(options.scale * rng.Uniform(-1, 1));
  const double x = options.shift_px * rng.Uniform(-1, 1), y = options.shift_px * rng.Uniform(-1, 1);
  const Eigen::Vector2d middle = Eigen::Vector2d::Constant(kCanvas / 2);
  return Eigen::Translation2d(middle + Eigen::Vector2d(x, y)) * Eigen::Rotation2Dd(angle) * Eigen::Scaling(factor) *
         Eigen::Translation2d(-middle);
}

/// The transform that moves `box` into `room`, shrinking it only if necessary.
Eigen::Affine2d Into(const Eigen::AlignedBox2d& room, const Eigen::AlignedBox2d& box) {
  const Eigen::Vector2d sizes = box.sizes().cwiseMax(1e-9);
  const double factor = std::min(1.0, (room.sizes().array() / sizes.array()).minCoeff());
  const Eigen::Vector2d half = 0.5 * factor * box.sizes();
  const Eigen::Vector2d centre = box.center().cwiseMax(room.min() + half).cwiseMin(room.max() - half);
  return Eigen::Translation2d(centre) * Eigen::Scaling(factor) * Eigen::Translation2d(-box.center());
}

std::vector<Stroke> Moved(const std::vector<Stroke>& strokes, const AugmentationOptions& options, Rng& rng) {
  std::vector<Stroke> moved = strokes;
  for (Stroke& stroke : moved) stroke = DeformStroke(std::move(stroke), options.stroke_shift_px, rng);
  moved = Transformed(DeformDrawing(std::move(moved), options.drawing_shift_px, rng), DrawPlacement(options, rng));

  const Eigen::AlignedBox2d canvas(Eigen::Vector2d::Constant(kMargin), Eigen::Vector2d::Constant(kCanvas - kMargin));
  const Eigen::AlignedBox2d room = canvas.merged(Bounds(strokes)), box = Bounds(moved);
  if (!box.isEmpty() && !room.contains(box)) moved = Transformed(std::move(moved), Into(room, box));

  const double tremor_px = options.tremor_px * rng.Uniform();
  for (Stroke& stroke : moved) stroke = Jitter(std::move(stroke), tremor_px, options.tremor_length_px, rng);
  return moved;
}

/// A stroke with a gap somewhere, or whole if it is shorter than two gaps.
CutStroke WithGap(const Stroke& stroke, double mean_gap_px, Rng& rng) {
  const double gap = mean_gap_px * rng.Uniform(0.5, 1.5), length = StrokeArc(stroke).length();
  const double begin = (length - gap) * rng.Uniform();
  if (length < 2 * gap) return {{stroke}, std::vector<bool>(stroke.points.size(), true)};
  return CutOut(stroke, begin, begin + gap);
}

}  // namespace

AugmentedSketch Augment(const std::vector<Stroke>& strokes, const AugmentationOptions& options, Rng& rng) {
  AugmentedSketch sketch{{}, {}, strokes, {}};
  for (const Stroke& stroke : strokes) sketch.visible.emplace_back(stroke.points.size(), true);
  if (options.strength == 0) {
    sketch.strokes = strokes;
    return sketch;
  }
  const AugmentationOptions scaled = TimesStrength(options);
  const double share = std::min(1.0, scaled.removal * rng.Uniform());
  const std::vector<bool> removed =
      DrawRemovedStrokes(strokes, static_cast<int>(std::lround(share * double(strokes.size()))),
                         scaled.removal_order_weight, scaled.removal_length_weight, rng);
  sketch.moved = Moved(strokes, scaled, rng);
  sketch.style.width *= std::exp(scaled.width * rng.Uniform(-1, 1));

  const double retraced = scaled.retrace * rng.Uniform(), gaps = scaled.gaps * rng.Uniform();
  for (size_t i = 0; i < strokes.size(); ++i) {
    const Stroke& stroke = sketch.moved[i];
    if (removed[i]) {
      sketch.visible[i].assign(stroke.points.size(), false);
    } else if (rng.Uniform() < retraced) {
      sketch.strokes.push_back(stroke);
      sketch.strokes.push_back(Jitter(stroke, scaled.retrace_px, kRetraceLength, rng));
    } else if (rng.Uniform() < gaps) {
      CutStroke cut = WithGap(stroke, scaled.gap_px, rng);
      sketch.visible[i] = std::move(cut.visible);
      for (Stroke& piece : cut.pieces) sketch.strokes.push_back(std::move(piece));
    } else {
      sketch.strokes.push_back(stroke);
    }
  }
  return sketch;
}

}  // namespace daumier::datasets
