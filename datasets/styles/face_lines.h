#pragma once
#include "core/options.h"
#include "core/random.h"
#include "datasets/styles/draw_in_style.h"
#include "render/framing.h"
#include "render/strokes.h"

#include <vector>

namespace daumier::datasets {

/// How much of what a regression network reads is drawn in styles of people.
struct StyledShare {
  double share = 0;
  double turn_degrees = 1.5;
  double scale = 0.03;
  double shift_px = 2.5;
  double mislabelled = 0.1;
  StyleOptions styles = DrawnAsTheFaceIs();

  /// The default styles without what disagrees with the face: mouths and eyes that are opened or closed, distorted
  /// proportions. A tenth are doodles.
  static StyleOptions DrawnAsTheFaceIs();

  template <class V>
  void Visit(V&& visit) {
    visit("share", share, Range{0, 1},
          "Share of sketches that are drawn in styles of people, what is not the face left out.");
    visit("turn_degrees", turn_degrees, Range{0, 45}, "Standard deviation of the error of the frame's turn.");
    visit("scale", scale, Range{0, 0.5}, "Standard deviation of the logarithm of the error of the frame's scale.");
    visit("shift_px", shift_px, Range{0, 64},
          "Standard deviation, along each axis, of the error of the frame's place.");
    visit("mislabelled", mislabelled, Range{0, 1},
          "Largest share of lines whose label is wrong: some of the face are missing, some of hair are there.");
    visit("styles", styles, Table{}, "Styles.");
  }
};

/// Whether a line of this label shows the face: not hair, neck or other lines, nor ears.
bool ShowsFace(faces::LineLabel label);

/// The lines of a drawing that show the face, in the frame of the sketch that it was made of: what a regression network
/// reads of a parsed drawing. Pieces of a stroke with other labels are cut out; kinds are LineLabels.
/// `error`: canvas to canvas, of the frame.
std::vector<render::Stroke> FaceLines(const StyledDrawing& drawing, const render::Placement& error = {});

/// FaceLines of a face drawn in a style, with errors of frame and labels. There is at least one line.
std::vector<render::Stroke> DrawFaceLines(const FaceShape& shape, const StyledShare& options, Rng& rng);

}  // namespace daumier::datasets
