#include "fitting/frame_search.h"

#include "fitting/quadratic_surface.h"

#include <algorithm>
#include <cmath>

namespace daumier::fitting {
namespace {

using Eigen::Vector2d;
using render::Placement;

/// Of a face's width to its height.
constexpr double kAspect = 0.8;
/// Reach of a surface around a frame: of the logarithm of scale, and of shift in pixels of the canvas.
constexpr double kScaleStep = 0.06, kShiftStep = 5.0;
/// Smaller surfaces about the mean of the best frames, where d has no noise to speak of but a sharp valley.
constexpr double kFineReaches[] = {0.5, 0.25};
/// Move, in reaches, below which a frame stays.
constexpr double kSmallMove = 0.2;
/// Frames that are averaged lie within this number of reaches of the best one; temperature of their weights, pixels.
constexpr double kNearReaches = 3.0, kTemperature = 0.1;

const Vector2d kCanvasCentre = Vector2d::Constant(0.5 * render::kSketchCanvas);

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
  const double face_height = render::FrameOptions{}.curve_height * render::kSketchCanvas;
  std::vector<Placement> frames;
  for (const double share : options.shares) {
    const Placement enlarged = Enlarged(drawing.placement, 1.0 / share, kCanvasCentre);
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

/// `steps`: of log scale and of shift, in reaches.
Placement Stepped(const Placement& frame, const Eigen::Vector3d& steps) {
  return Moved(Enlarged(frame, std::exp(kScaleStep * steps[0]), kCanvasCentre), kShiftStep * steps.tail<2>());
}

/// The steps from one frame to another: Stepped(from, StepsBetween(from, to)) = to.
Eigen::Vector3d StepsBetween(const Placement& from, const Placement& to) {
  const double factor = to.scale / from.scale;
  const Vector2d shift = to.shift - Enlarged(from, factor, kCanvasCentre).shift;
  return {std::log(factor) / kScaleStep, shift.x() / kShiftStep, shift.y() / kShiftStep};
}

/// The mean of those candidates that are near the best one, in its steps.
Placement MeanNearBest(const std::vector<Candidate>& candidates, const Candidate& best) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double total = 0.0;
  for (const Candidate& candidate : candidates) {
    const Eigen::Vector3d steps = StepsBetween(best.placement, candidate.placement);
    if (steps.cwiseAbs().maxCoeff() > kNearReaches) continue;
    const double weight = std::exp((best.distance_px - candidate.distance_px) / kTemperature);
    sum += weight * steps;
    total += weight;
  }
  return Stepped(best.placement, sum / total);
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
  const Candidate of_box = candidates.front();
  std::stable_sort(candidates.begin(), candidates.end(), nearer);
  candidates.resize(std::min(candidates.size(), size_t(options.starts)));
  const Eigen::MatrixXd design = CompositeDesign(3);
  const auto improve = [&](Candidate& candidate, double reach) {
    for (int round = 0; round < options.rounds; ++round) {
      std::vector<Placement> around;
      for (const auto& steps : design.rowwise())
        around.push_back(Stepped(candidate.placement, reach * steps.transpose()));
      const std::vector<Candidate> tried = try_all(around);
      Eigen::VectorXd distances(design.rows());
      for (Eigen::Index i = 0; i < design.rows(); ++i) distances[i] = tried[size_t(i)].distance_px;
      const QuadraticSurface surface = FitQuadraticSurface(design, distances);
      const Eigen::Vector3d lowest = surface.LowestInBox();
      candidate = {Stepped(candidate.placement, reach * lowest), surface.At(lowest)};
      if (lowest.cwiseAbs().maxCoeff() < kSmallMove) break;
    }
  };
  for (Candidate& candidate : candidates) improve(candidate, 1.0);
  const Candidate& best = *std::min_element(candidates.begin(), candidates.end(), nearer);
  Candidate found = of_box;
  if (options.rounds > 0 || best.distance_px < of_box.distance_px) {
    Candidate mean{MeanNearBest(candidates, best), 0.0};
    for (const double reach : kFineReaches) improve(mean, reach);
    found = try_all({mean.placement}).front();
  }
  if (nearer(of_box, found)) found = of_box;
  return {.placement = found.placement, .distance_px = found.distance_px, .start_distance_px = of_box.distance_px};
}

}  // namespace daumier::fitting
