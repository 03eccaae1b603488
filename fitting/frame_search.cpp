#include "fitting/frame_search.h"

#include <algorithm>
#include <cmath>

namespace daumier::fitting {
namespace {

using Eigen::Vector2d;
using render::Placement;

/// Of a face's width to its height.
constexpr double kAspect = 0.8;
/// The first steps around a frame: of scale, and of shift in pixels of the canvas.
constexpr double kScaleStep = 0.12, kShiftStep = 10.0;

struct Candidate {
  Placement placement;
  double distance_px;
};

/// The frame enlarged about a point of the canvas that stays.
Placement Enlarged(const Placement& placement, double factor, const Vector2d& about) {
  return {factor * placement.scale, factor * (placement.shift - about) + about};
}

Placement Moved(const Placement& placement, const Vector2d& by) {
  return {placement.scale, placement.shift + by};
}

/// From 0 to 1; a half if there is one alone.
double GridPosition(int index, int count) {
  return count == 1 ? 0.5 : double(index) / (count - 1);
}

std::vector<Placement> CoarseFrames(const render::FramedDrawing& drawing, const FrameSearchOptions& options) {
  const Vector2d centre = Vector2d::Constant(0.5 * render::kSketchCanvas);
  const double face_height = render::FrameOptions{}.curve_height * render::kSketchCanvas;
  std::vector<Placement> frames;
  for (const double share : options.shares) {
    const Placement enlarged = Enlarged(drawing.placement, 1.0 / share, centre);
    const Vector2d slack =
        (enlarged.scale * drawing.box.sizes() - Vector2d(kAspect * face_height, face_height)).cwiseMax(0.0);
    for (int x = 0; x < (slack.x() > 0 ? options.places_x : 1); ++x) {
      for (int y = 0; y < (slack.y() > 0 ? options.places_y : 1); ++y) {
        const Vector2d place(slack.x() > 0 ? GridPosition(x, options.places_x) : 0.5,
                             slack.y() > 0 ? GridPosition(y, options.places_y) : 0.5);
        frames.push_back(Moved(enlarged, (Vector2d::Constant(0.5) - place).cwiseProduct(slack)));
      }
    }
  }
  return frames;
}

std::vector<Placement> FramesAround(const Placement& frame, double step) {
  const Vector2d centre = Vector2d::Constant(0.5 * render::kSketchCanvas);
  std::vector<Placement> frames;
  for (const double sign : {-1.0, 1.0}) {
    frames.push_back(Enlarged(frame, 1.0 + sign * step * kScaleStep, centre));
    frames.push_back(Moved(frame, {sign * step * kShiftStep, 0.0}));
    frames.push_back(Moved(frame, {0.0, sign * step * kShiftStep}));
  }
  return frames;
}

}  // namespace

FoundFrame FindFrame(const render::FramedDrawing& drawing, const CurvesOfSketches& predict,
                     const FrameSearchOptions& options, const Task& task) {
  const auto try_all = [&](const std::vector<Placement>& frames) {
    std::vector<std::vector<render::Stroke>> sketches;
    for (const Placement& frame : frames) sketches.push_back(render::MapToCanvas(drawing.strokes, frame));
    task.ThrowIfCancelled("stopped while the frame of the drawing was searched");
    const auto curves = predict(sketches);
    std::vector<Candidate> candidates;
    for (size_t i = 0; i < frames.size(); ++i) {
      task.ThrowIfCancelled("stopped while the frame of the drawing was searched");
      const auto distance = DistanceBetween(sketches[i], curves[i], options.drawn_trim, options.projected_trim);
      candidates.push_back({frames[i], distance.two_way()});
    }
    return candidates;
  };
  const auto nearer = [](const Candidate& a, const Candidate& b) { return a.distance_px < b.distance_px; };

  std::vector<Placement> coarse = CoarseFrames(drawing, options);
  coarse.insert(coarse.begin(), drawing.placement);
  std::vector<Candidate> candidates = try_all(coarse);
  const double start_distance_px = candidates.front().distance_px;
  std::stable_sort(candidates.begin(), candidates.end(), nearer);
  candidates.resize(std::min(candidates.size(), size_t(options.starts)));
  for (Candidate& best : candidates) {
    double step = 1.0;
    for (int halving = 0; halving < options.halvings;) {
      const auto around = try_all(FramesAround(best.placement, step));
      const auto nearest = std::min_element(around.begin(), around.end(), nearer);
      if (nearer(*nearest, best)) {
        best = *nearest;
      } else {
        ++halving, step *= 0.5;
      }
    }
  }
  const Candidate& best = *std::min_element(candidates.begin(), candidates.end(), nearer);
  return {.placement = best.placement, .distance_px = best.distance_px, .start_distance_px = start_distance_px};
}

}  // namespace daumier::fitting
