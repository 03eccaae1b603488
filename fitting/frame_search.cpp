#include "fitting/frame_search.h"

#include "fitting/quadratic_surface.h"

#include <Eigen/Eigenvalues>

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
/// Frames within this number of reaches of a surface's middle count for it.
constexpr double kSurfaceRadius = 1.5;
/// Move, in reaches, below which a frame stays.
constexpr double kSmallMove = 0.2;
/// Within this number of reaches of a frame that an earlier start led to, a start is given up.
constexpr double kSameFrame = 0.5;
/// Frames of each of the last surfaces, and how many of these there are once the frame stays.
constexpr int kLastFrames = 32, kLastSurfaces = 3;
/// The last surfaces reach as far along each axis of the one before as that rises by this, pixels: some five times the
/// noise of d. Least and greatest reach.
constexpr double kRise = 0.2, kLeastReach = 0.15, kMostReach = 1.0;
/// Reaches of the frames that are weighted, and the temperature of their weights, pixels.
constexpr double kWeightedReaches[] = {0.5, 0.25};
constexpr double kTemperature = 0.05;

const Vector2d kCanvasCentre = Vector2d::Constant(0.5 * render::kSketchCanvas);

struct Candidate {
  Placement placement;
  double distance_px;
};

/// The frame enlarged about a point of the canvas that stays.
Placement Enlarged(const Placement& placement, double factor, const Vector2d& about) {
  return {factor * placement.scale, factor * (placement.shift - about) + about, placement.turn_degrees};
}

Placement Moved(const Placement& placement, const Vector2d& by) {
  return {placement.scale, placement.shift + by, placement.turn_degrees};
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

/// The quadratic surface of the distances about a frame, weighted by Tukey's biweight. Its variables are those of
/// which `reach` makes steps.
QuadraticSurface SurfaceAbout(const Placement& middle, const Eigen::Matrix3d& reach,
                              const std::vector<Candidate>& tried) {
  const Eigen::Matrix3d inverse = reach.inverse();
  std::vector<Eigen::Vector3d> near;
  std::vector<double> distances, weights;
  for (const Candidate& candidate : tried) {
    const Eigen::Vector3d place = inverse * StepsBetween(middle, candidate.placement);
    const double rest = 1.0 - place.squaredNorm() / (kSurfaceRadius * kSurfaceRadius);
    if (rest <= 0.0) continue;
    near.push_back(place);
    distances.push_back(candidate.distance_px);
    weights.push_back(rest * rest);
  }
  Eigen::MatrixXd places(Eigen::Index(near.size()), 3);
  for (size_t i = 0; i < near.size(); ++i) places.row(Eigen::Index(i)) = near[i].transpose();
  return FitQuadraticSurface(places, Eigen::Map<Eigen::VectorXd>(distances.data(), places.rows()),
                             Eigen::Map<Eigen::VectorXd>(weights.data(), places.rows()));
}

/// The axes of a surface whose variables are those of `reach`, each as long as it rises by kRise from its middle.
Eigen::Matrix3d ReachOf(const QuadraticSurface& surface, const Eigen::Matrix3d& reach) {
  const Eigen::Matrix3d inverse = reach.inverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(inverse.transpose() * surface.hessian * inverse);
  const Eigen::Array3d bends = axes.eigenvalues().array().max(2.0 * kRise / (kMostReach * kMostReach));
  return axes.eigenvectors() * (2.0 * kRise / bends).sqrt().max(kLeastReach).matrix().asDiagonal();
}

std::vector<Placement> WeightedFrames(const Placement& middle) {
  const Eigen::MatrixXd design = CompositeDesign(3);
  std::vector<Placement> frames;
  for (const double reach : kWeightedReaches)
    for (const auto& place : design.topRows(design.rows() - 1).rowwise())
      frames.push_back(Stepped(middle, reach * place.transpose()));
  return frames;
}

/// The found frame and others about it.
std::vector<WeightedFrame> Weighted(const Candidate& found, std::vector<Candidate> others) {
  others.insert(others.begin(), found);
  double least = found.distance_px, sum = 0.0;
  for (const Candidate& candidate : others) least = std::min(least, candidate.distance_px);
  std::vector<WeightedFrame> weighted;
  for (const Candidate& candidate : others) {
    weighted.push_back({candidate.placement, std::exp((least - candidate.distance_px) / kTemperature)});
    sum += weighted.back().weight;
  }
  for (WeightedFrame& frame : weighted) frame.weight /= sum;
  return weighted;
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
  std::vector<Candidate> tried = try_all(coarse), candidates = tried;
  const Candidate of_box = candidates.front();
  std::stable_sort(candidates.begin(), candidates.end(), nearer);
  candidates.resize(std::min(candidates.size(), size_t(options.starts)));
  struct Improvement {
    QuadraticSurface surface;
    double move;  ///< Largest coordinate, in reaches.
  };
  /// Tries frames about the candidate and moves it to the lowest place of the surface.
  const auto improve = [&](Candidate& candidate, const Eigen::MatrixXd& design, const Eigen::Matrix3d& reach) {
    std::vector<Placement> around;
    for (const auto& place : design.rowwise())
      around.push_back(Stepped(candidate.placement, reach * place.transpose()));
    const std::vector<Candidate> more = try_all(around);
    tried.insert(tried.end(), more.begin(), more.end());
    QuadraticSurface surface = SurfaceAbout(candidate.placement, reach, tried);
    const Eigen::Vector3d lowest = surface.LowestInBox();
    candidate = {Stepped(candidate.placement, reach * lowest), surface.At(lowest)};
    return Improvement{std::move(surface), lowest.cwiseAbs().maxCoeff()};
  };
  const Eigen::Matrix3d whole = Eigen::Matrix3d::Identity();
  std::vector<Candidate> improved;
  const auto improve_start = [&](Candidate candidate) {
    for (int round = 0; round < options.rounds; ++round) {
      for (const Candidate& earlier : improved)
        if (StepsBetween(earlier.placement, candidate.placement).cwiseAbs().maxCoeff() < kSameFrame) return;
      if (improve(candidate, CompositeDesign(3), whole).move < kSmallMove) break;
    }
    improved.push_back(candidate);
  };
  for (const Candidate& candidate : candidates) improve_start(candidate);
  Candidate found = *std::min_element(improved.begin(), improved.end(), nearer);
  if (options.rounds > 0) {
    Eigen::Matrix3d reach = whole;
    int num_frames = 0;
    const auto improve_last = [&] {
      const Improvement last = improve(found, SpreadDesign(3, num_frames, kLastFrames), reach);
      num_frames += kLastFrames;
      return last;
    };
    Improvement last = improve_last();
    for (int round = 1; round < options.rounds && last.move >= kSmallMove; ++round) last = improve_last();
    for (int i = 1; i < kLastSurfaces; ++i) {
      reach = ReachOf(last.surface, reach);
      last = improve_last();
    }
    found = try_all({found.placement}).front();
  }
  if (nearer(of_box, found)) found = of_box;
  std::vector<WeightedFrame> near{{found.placement, 1.0}};
  if (options.rounds > 0) near = Weighted(found, try_all(WeightedFrames(found.placement)));
  return {.placement = found.placement,
          .distance_px = found.distance_px,
          .start_distance_px = of_box.distance_px,
          .near = std::move(near)};
}

}  // namespace daumier::fitting
