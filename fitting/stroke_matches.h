#pragma once
#include "fitting/label_curves.h"
#include "fitting/labelled_drawing.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace daumier::fitting {

/// A place on a labelled stroke.
struct StrokeSample {
  Eigen::Vector2d position, direction;  ///< Pixels; the direction is of length 1.
  faces::LineLabel label;
};

/// Places on the strokes, `step` apart, of labels that have curves of a face. At most `most`: the step grows.
std::vector<StrokeSample> SampleStrokes(const LabelledDrawing& drawing, double step, size_t most);

/// A place of a curve and the sample that it is drawn to, along the curve's normal.
struct StrokeMatch {
  faces::PolylinePlace place;
  Eigen::Vector2d target, normal;
  double trust;
};

struct StrokeMatchOptions {
  double reach = 16;                                 ///< Pixels.
  double least_cosine = 0.5;                         ///< Between the directions of curve and stroke.
  std::array<bool, 2> closed_eyes = {false, false};  ///< Right, left: the line of a closed eye shows the lower lid.
};

/// Each sample matches the nearest place of a curve of its label within reach that runs in about its direction; neither
/// beyond an open curve's ends nor inside a closed curve, which is a filled brow. projected: n x 2, pixels.
std::vector<StrokeMatch> MatchStrokes(const std::vector<StrokeSample>& samples, const std::vector<LabelCurve>& curves,
                                      const Eigen::MatrixX2d& projected, const StrokeMatchOptions& options);

}  // namespace daumier::fitting
