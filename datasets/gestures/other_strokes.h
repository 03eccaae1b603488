#pragma once
#include "datasets/styles/polylines.h"

#include <string>

/// Strokes that are no gesture: what people draw and write, and what nearly is a gesture.
namespace daumier::datasets {

enum class OtherStrokeKind {
  kGlyph,         ///< Letters, digits, signs.
  kArc,           ///< Arcs from a slight bow to a ring with a wide gap, also of uneven curvature: brows, lids, mouths.
  kWave,          ///< Waves, scallops, curls without loops.
  kZigzag,        ///< Two or more sharp peaks, stairs among them.
  kSpiral,        ///< More than one turn and a half.
  kCorner,        ///< V and L, ticks, and thin wedges.
  kOpenPolygon,   ///< Some sides of a polygon.
  kScribble,      ///< Hatching, and wild curves.
  kManyLoops,     ///< Four to nine loops in any direction.
  kLevelLoops,    ///< One to three loops along a level or an upright line.
  kMixedLoops,    ///< Loops of both senses; a ring with long crossing ends.
  kTurnedArrow,   ///< An arrow that is upright or slanted.
  kDoubleArrow,   ///< Hooks at both ends.
  kBrokenArrow,   ///< An arrow whose shaft has a corner or a half turn.
  kTailedRegion,  ///< A closed line and a long tail.
  kDrawing,       ///< Lines of faces: noses, ears, lips, hair.
  kWandering,     ///< Straight pieces, arcs and corners in any order.
};
inline constexpr int kNumOtherStrokeKinds = 17;

/// "glyph", "arc" ...
std::string NameOf(OtherStrokeKind kind);

/// One of these, of a size of any order. Promises: neither nearly straight nor nearly closed (StrokeForm).
Polyline DrawOtherShape(OtherStrokeKind kind, Rng& rng);

}  // namespace daumier::datasets
