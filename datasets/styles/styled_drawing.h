#pragma once
#include "faces/drawing_terms.h"
#include "render/framing.h"

#include <array>
#include <optional>
#include <vector>

namespace daumier::datasets {

/// A stroke of a drawing on the canvas of render::kSketchCanvas pixels.
struct StyledStroke {
  float width = 1.5f;   ///< Pixels.
  bool filled = false;  ///< The area inside is ink too; the last point is joined to the first.
  std::vector<std::array<float, 2>> points;
  std::vector<faces::LineLabel> labels;  ///< Of each point: one stroke may go round the upper and the lower lip.

  bool operator==(const StyledStroke&) const = default;
};

/// Something that a drawing shows once a number of its strokes are there.
template <class T>
struct ShownWith {
  T value{};
  int num_strokes = 0;  ///< The first strokes that it takes; 0: the drawing does not show it at all.

  bool is_shown() const { return num_strokes > 0; }
  bool operator==(const ShownWith&) const = default;
};

/// A drawing of a face as a person might make it, and what it shows.
/// Promises: each stroke has points, and all lie on the canvas; a point of the face that is shown lies within
/// kLandmarkTolerance of a stroke of the feature that it belongs to, but for the centres of eyes.
struct StyledDrawing {
  static constexpr double kLandmarkTolerance = 4;

  std::vector<StyledStroke> strokes;  ///< In the order in which they are drawn.
  std::array<ShownWith<std::array<float, 2>>, faces::kNumFacePoints>
      points;  ///< By faces::FacePoint, pixels of the canvas.
  ShownWith<faces::MouthState> mouth;
  std::array<ShownWith<faces::EyeState>, 2>
      eyes;  ///< Right, left. An eye that is a mark (a dot, a dash) shows no state.
  ShownWith<faces::DrawnView> view;
  render::Placement pose;  ///< Where the sheet of the sketch lies on the canvas.

  bool operator==(const StyledDrawing&) const = default;
};

/// The drawing when its first strokes alone are there. @throws Error unless 1 <= num_strokes <= all.
StyledDrawing FirstStrokes(StyledDrawing drawing, int num_strokes);

/// The mirror image: right and left change places, x becomes kSketchCanvas - x; turn_degrees and shift are those of the
/// mirrored sheet (x of the sheet becomes kSketchCanvas - x too).
StyledDrawing Mirrored(StyledDrawing drawing);

}  // namespace daumier::datasets
