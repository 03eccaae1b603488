#pragma once
#include "core/options.h"
#include "core/random.h"
#include "render/strokes.h"

#include <vector>

namespace daumier::datasets {

/// Lengths are pixels of the 256 canvas. Every effect draws its size for each sketch.
struct AugmentationOptions {
  double strength = 0;
  double removal = 0.3;
  double removal_order_weight = 0.5;
  double removal_length_weight = 2;
  double stroke_shift_px = 2;
  double drawing_shift_px = 4;
  double width = 0.4;
  double retrace = 0.3;
  double retrace_px = 1.5;
  double tremor_px = 0.5;
  double tremor_length_px = 16;
  double gaps = 0.2;
  double gap_px = 8;
  double shift_px = 6;
  double scale = 0.05;
  double rotation_degrees = 3;

  template <class V>
  void Visit(V&& visit) {
    visit("strength", strength, Range{0, 4},
          "Factor of the shares and sizes below, except where marked. 0: sketches are unchanged, 1: for training, 2: "
          "strong.");
    visit("removal", removal, Range{0, 1}, "Largest share of removed strokes.");
    visit("removal_order_weight", removal_order_weight, Range{0, 10},
          "Late strokes are removed more often: each later position in the list multiplies the weight of a stroke in "
          "the draw by e to this power. Not scaled by strength.");
    visit("removal_length_weight", removal_length_weight, Range{0, 100},
          "Short strokes are removed more often: each canvas width of length divides the weight of a stroke in the "
          "draw by e to this power. Not scaled by strength.");
    visit("stroke_shift_px", stroke_shift_px, Range{0, 64},
          "Root mean square shift, along each axis, of the handles that bend a straight stroke; curved strokes are "
          "bent less.");
    visit("drawing_shift_px", drawing_shift_px, Range{0, 64},
          "Standard deviation, along each axis, of the shift of the four extreme points that bend the whole drawing.");
    visit("width", width, Range{0, 2}, "Logarithm of the largest factor of the stroke width.");
    visit("retrace", retrace, Range{0, 1}, "Largest share of strokes that are drawn twice.");
    visit("retrace_px", retrace_px, Range{0, 32},
          "Distance of the second line from the first, root mean square along each axis.");
    visit("tremor_px", tremor_px, Range{0, 16}, "Largest tremor of the hand, root mean square along each axis.");
    visit("tremor_length_px", tremor_length_px, Range{1, 256},
          "Approximate length of the shortest tremor along a stroke. Not scaled by strength.");
    visit("gaps", gaps, Range{0, 1}, "Largest share of strokes with a gap.");
    visit("gap_px", gap_px, Range{0.1, 256}, "Mean length of a gap. Not scaled by strength.");
    visit("shift_px", shift_px, Range{0, 128}, "Largest shift of the drawing along each axis.");
    visit("scale", scale, Range{0, 1}, "Logarithm of the largest factor of the drawing's size.");
    visit("rotation_degrees", rotation_degrees, Range{0, 180}, "Largest rotation of the drawing.");
  }
};

/// A sketch as another hand might have drawn it.
struct AugmentedSketch {
  std::vector<render::Stroke> strokes;  ///< To be drawn: without what is left out, cut at gaps, some of them twice.
  render::StrokeStyle style;
  std::vector<render::Stroke> moved;       ///< All points that came in, in their order, where the sketch has them now.
  std::vector<std::vector<bool>> visible;  ///< Of each point of `moved`: whether the sketch shows its stroke there.
};

/// Sketch augmentation [Yu et al. 2016] on strokes of the 256 canvas, and the pen. Strokes are left out, never all;
/// they are bent one by one and all together; the drawing is turned, scaled and shifted; what this carries out of the
/// canvas, less a margin of 3 pixels, is shifted back, or shrunk if it does not fit, but a sketch that left it before
/// may do so as far. Then the pen trembles, draws some strokes twice, the second time whole, and leaves gaps in others
/// that are longer than two gaps. Closed strokes stay closed. With strength 0 the strokes come back bit for bit, with
/// the default style. The same strokes, options and state of `rng` give the same bytes.
AugmentedSketch Augment(const std::vector<render::Stroke>& strokes, const AugmentationOptions& options, Rng& rng);

}  // namespace daumier::datasets
