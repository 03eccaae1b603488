#pragma once
#include "faces/drawing_terms.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace daumier::fitting {

/// A stroke on a canvas and what each of its points shows.
struct LabelledStroke {
  std::vector<std::array<float, 2>> points;
  std::vector<faces::LineLabel> labels;  ///< As many.
};

/// A point of a face in a drawing.
struct LabelledPoint {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double confidence = 0;  ///< 0 (not shown) .. 1
};

/// What a parser of drawings, or a person with a pencil, says of a drawing. Coordinates are pixels of the canvas of
/// sketches, x to the right, y down. Probabilities that are all 0 say nothing.
struct LabelledDrawing {
  std::vector<LabelledStroke> strokes;
  std::array<LabelledPoint, faces::kNumFacePoints> points{};       ///< By faces::FacePoint.
  std::array<double, faces::kNumMouthStates> mouth{};              ///< By faces::MouthState.
  std::array<std::array<double, faces::kNumEyeStates>, 2> eyes{};  ///< Right, left; by faces::EyeState.
  std::array<double, faces::kNumDrawnViews> view{};                ///< By faces::DrawnView.

  const LabelledPoint& point(faces::FacePoint of) const { return points[size_t(of)]; }
  LabelledPoint& point(faces::FacePoint of) { return points[size_t(of)]; }
};

}  // namespace daumier::fitting
