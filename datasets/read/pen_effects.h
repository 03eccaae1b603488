#pragma once
#include "core/random.h"
#include "render/strokes.h"

#include <vector>

namespace daumier::datasets {

/// Smooth noise along a stroke, as of a hand that is not quite steady: both coordinates are moved by cubic B-splines of
/// the arc length with independent normal coefficients length_px apart, of root mean square rms_px (to 2 % at any arc
/// length), so that nothing much shorter than length_px trembles. A closed stroke stays closed: its coefficients go
/// round, at least four of them.
render::Stroke Jitter(render::Stroke stroke, double rms_px, double length_px, Rng& rng);

/// What is left of a stroke: the pieces to draw, and of each of its points whether it is on one.
struct CutStroke {
  std::vector<render::Stroke> pieces;
  std::vector<bool> visible;
};

/// Without all strictly between two arc lengths in pixels: pieces end exactly there; one without length is left out.
/// A stroke of one point has no length. @throws Error if begin > end.
CutStroke CutOut(const render::Stroke& stroke, double begin, double end);

}  // namespace daumier::datasets
