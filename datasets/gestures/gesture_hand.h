#pragma once
#include "core/options.h"
#include "datasets/styles/polylines.h"

namespace daumier::datasets {

/// How sloppily people draw gestures, and with what.
struct GestureHandOptions {
  double bend = 0.012;
  double rounding = 0.02;
  double tremor_px = 0.7;
  double mouse = 0.6;
  double sparse = 0.2;
  double smallest_px = 40;
  double largest_px = 700;

  template <class V>
  void Visit(V&& visit) {
    visit("bend", bend, Range{0, 0.1},
          "Usual deviation of a stroke that bends as a whole, in lengths of its longer side.");
    visit("rounding", rounding, Range{0, 0.2}, "Usual share of the length over which corners are rounded.");
    visit("tremor_px", tremor_px, Range{0, 10}, "Usual tremor, pixels.");
    visit("mouse", mouse, Range{0, 1}, "Share of hands with a mouse: whole pixels, the others have a pen.");
    visit("sparse", sparse, Range{0, 1}, "Share of strokes so fast that few points are left.");
    visit("smallest_px", smallest_px, Range{8, 10000}, "Least longer side of a stroke, pixels.");
    visit("largest_px", largest_px, Range{8, 10000}, "Greatest longer side of a stroke, pixels.");
  }
};

/// The habits of one person.
struct GestureHand {
  double bend, rounding, tremor_px;
  bool has_mouse;
  double sparse;
  double smallest_px, largest_px;
};

/// @throws UsageError if the smallest stroke is larger than the largest.
GestureHand DrawGestureHand(const GestureHandOptions& options, Rng& rng);

/// A shape as the hand draws it: placed and sized, bent, its corners rounded, with tremor and hooks at its ends, sampled
/// regularly in time by a hand that is slow in turns. Pixels of a screen, y down.
/// Promises: at least two points that differ; all are finite, and whole numbers of a mouse; neighbours differ.
Polyline DrawWithHand(const Polyline& shape, const GestureHand& hand, Rng& rng);

}  // namespace daumier::datasets
