#pragma once
#include "core/options.h"
#include "core/task.h"
#include "fitting/stroke_distance.h"
#include "render/framing.h"
#include "render/strokes.h"

#include <functional>
#include <vector>

namespace daumier::fitting {

struct FrameSearchOptions {
  std::vector<double> shares = {1.15, 1.0, 0.87, 0.75, 0.65, 0.56, 0.48};
  int places_x = 3;
  int places_y = 5;
  double drawn_trim = 0.5;
  double projected_trim = 0.05;
  int starts = 6;
  int rounds = 6;

  template <class V>
  void Visit(V&& visit) {
    visit("shares", shares, Range{0.1, 2},
          "Shares of the drawing's height that its face may have; the rest is hair, neck and shoulders.");
    visit("places_x", places_x, Range{1, 99}, "Places of the face from the drawing's left to its right.");
    visit("places_y", places_y, Range{1, 99}, "Places of the face from the drawing's top to its bottom.");
    visit("drawn_trim", drawn_trim, Range{0, 0.99},
          "Share of the drawn lines, the farthest from the face's, that does not count.");
    visit("projected_trim", projected_trim, Range{0, 0.99}, "The same of the face's lines.");
    visit("starts", starts, Range{1, 99}, "How many of the best frames are improved.");
    visit("rounds", rounds, Range{0, 20}, "How often each of them is improved at most.");
  }
};

/// Sketches on the canvas -> the feature curves of the face that is predicted from each, on the canvas.
using CurvesOfSketches =
    std::function<std::vector<std::vector<render::Stroke>>(const std::vector<std::vector<render::Stroke>>& sketches)>;

struct WeightedFrame {
  render::Placement placement;
  double weight;
};

struct FoundFrame {
  render::Placement placement;
  double distance_px = 0.0;        ///< Trimmed and two-way, at `placement`.
  double start_distance_px = 0.0;  ///< The same of the frame of the bounding box.
  /// `placement` and, where frames are improved, 28 up to 3 % and 2.5 pixels away, weighted by exp(-d / 0.05 px); the
  /// weights' sum is 1. The mean of their faces depends less on the least change of a line than one face.
  std::vector<WeightedFrame> near;
};

/// Finds the scale and shift that align a drawing with the training sketches: where the predicted face is nearest to the
/// drawing (DistanceBetween d, two-way and trimmed). First the frame of the bounding box is tried, and faces that take a
/// share of the drawing's height, at some places of its box. d is a noisy function of the frame (some 0.04 px), in flat
/// valleys: a face 3 % larger may be 0.03 px farther. A frame is therefore the lowest place of a quadratic surface that
/// is fitted to d (FitQuadraticSurface; log scale and shift, 6 % and 5 pixels to each side) at all frames tried about
/// it. From each of the best frames such surfaces lead to the next one; the best of these is improved by more frames, in
/// the end only as far about it as the surface rises by 0.2 px, at least 0.9 % and 0.75 pixels: less far across a sharp
/// valley, where a wide surface is no good fit, than along a flat one, where a small surface would fit noise. Never
/// farther from the drawing than the frame of the bounding box.
/// @throws Error as DistanceBetween and what `predict` throws; Cancelled if the task is.
FoundFrame FindFrame(const render::FramedDrawing& drawing, const CurvesOfSketches& predict,
                     const FrameSearchOptions& options = {}, const Task& task = {});

}  // namespace daumier::fitting
