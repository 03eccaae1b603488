#include "render/framing.h"

#include "core/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace daumier::render {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;

/// Share of the length of all strokes that may lie beyond each side of the core box.
constexpr double kShareOutside = 0.02;
/// A stroke belongs to the drawing if it comes nearer to the core box than this share of the box's longer side.
constexpr double kReach = 0.15;

/// Scribbles much longer than the sheet is wide are sampled more coarsely.
constexpr double kMostSamples = 1e6;

struct Sample {
  double coordinate, length;
};

/// The coordinate below which `share` of the length lies.
double WeightedQuantile(std::vector<Sample> samples, double share) {
  std::sort(samples.begin(), samples.end(),
            [](const Sample& a, const Sample& b) { return a.coordinate < b.coordinate; });
  double total = 0.0, sum = 0.0;
  for (const auto& sample : samples) total += sample.length;
  for (const auto& sample : samples) {
    sum += sample.length;
    if (sum >= share * total) return sample.coordinate;
  }
  return samples.back().coordinate;
}

AlignedBox2d BoxOf(const Stroke& stroke) {
  AlignedBox2d box;
  for (const auto& [x, y] : stroke.points) {
    DAUMIER_CHECK(std::isfinite(x) && std::isfinite(y), "a point of the drawing is ({}, {})", x, y);
    box.extend(Vector2d(x, y));
  }
  return box;
}

/// The box that holds all but the outermost lengths of the strokes.
AlignedBox2d CoreBox(const std::vector<Stroke>& strokes, double step) {
  double total_length = 0.0;
  for (const auto& stroke : strokes)
    for (size_t i = 1; i < stroke.points.size(); ++i)
      total_length += std::hypot(double(stroke.points[i][0]) - stroke.points[i - 1][0],
                                 double(stroke.points[i][1]) - stroke.points[i - 1][1]);
  step = std::max(step, total_length / kMostSamples);
  std::array<std::vector<Sample>, 2> samples;
  for (const auto& stroke : strokes) {
    for (size_t i = 1; i < stroke.points.size(); ++i) {
      const Vector2d from(stroke.points[i - 1][0], stroke.points[i - 1][1]);
      const Vector2d to(stroke.points[i][0], stroke.points[i][1]);
      const double length = (to - from).norm();
      const int num_parts = std::max(1, static_cast<int>(std::ceil(length / step)));
      for (int part = 0; part < num_parts; ++part) {
        const Vector2d point = from + (part + 0.5) / num_parts * (to - from);
        for (int axis = 0; axis < 2; ++axis) samples[axis].push_back({point[axis], length / num_parts});
      }
    }
  }
  AlignedBox2d box;
  if (samples[0].empty()) return box;
  for (const double share : {kShareOutside, 1.0 - kShareOutside}) {
    box.extend(Vector2d(WeightedQuantile(samples[0], share), WeightedQuantile(samples[1], share)));
  }
  return box;
}

}  // namespace

FramedDrawing FrameDrawing(const Drawing& drawing, const FrameOptions& options) {
  AlignedBox2d whole;
  for (const auto& stroke : drawing.strokes) whole.extend(BoxOf(stroke));
  DAUMIER_CHECK(!whole.isEmpty() && whole.sizes().maxCoeff() > 0.0, "the drawing has no extent");
  constexpr double kNumSteps = 500.0;
  AlignedBox2d reach = CoreBox(drawing.strokes, whole.sizes().maxCoeff() / kNumSteps);
  if (reach.isEmpty()) reach = whole;
  const double margin = kReach * reach.sizes().maxCoeff();
  reach = AlignedBox2d(reach.min().array() - margin, reach.max().array() + margin);

  FramedDrawing framed;
  for (const auto& stroke : drawing.strokes) {
    const AlignedBox2d own = BoxOf(stroke);
    if (stroke.points.empty() || !reach.intersects(own)) continue;
    framed.box.extend(own);
    framed.strokes.push_back(stroke);
  }
  const Vector2d size = framed.box.sizes().cwiseMax(1e-9 * whole.sizes().maxCoeff());
  framed.placement.scale = kSketchCanvas * std::min(options.curve_height / size.y(), options.max_width / size.x());
  framed.placement.shift = Vector2d::Constant(0.5 * kSketchCanvas) - framed.placement.scale * framed.box.center();
  return framed;
}

std::vector<Stroke> FrameStrokes(const Drawing& drawing, const FrameOptions& options) {
  const FramedDrawing framed = FrameDrawing(drawing, options);
  return MapToCanvas(framed.strokes, framed.placement);
}

std::vector<Stroke> MapToCanvas(const std::vector<Stroke>& strokes, const Placement& placement) {
  std::vector<Stroke> placed = strokes;
  for (auto& stroke : placed) {
    for (auto& [x, y] : stroke.points) {
      x = static_cast<float>(placement.scale * x + placement.shift.x());
      y = static_cast<float>(placement.scale * y + placement.shift.y());
    }
  }
  return placed;
}

}  // namespace daumier::render
