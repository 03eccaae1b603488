#pragma once
#include "datasets/gestures/pen_motion.h"

/// What a person aims at whose stroke is none of the ten gestures.
namespace daumier::datasets {

enum class OtherStroke {
  kGlyph,  ///< Letters, digits, brackets, a lightning, stairs.
  kZigzag,
  kSpiral,  ///< At least 2.2 turns, in- or outwards.
  kTick,
  kArc,  ///< 80 to 240 degrees.
  kWave,
  kStar,  ///< Unfinished.
  kOpenHeart,
  kOpenPolygon,
  kCorner,  ///< L and V.
  kScribble,
  kVerticalArrow,
  kDoubleArrow,  ///< A head at each end.
  kLongRoll,     ///< Four to six loops.
  kFlatCoil,     ///< Two to four loops along the sheet or across it.
  kDot,
  kShortHook
};
inline constexpr int kNumOtherStrokes = 17;

/// Points in pixels around the origin, y down. @throws Error if there is no such kind.
PenPlan PlanOtherStroke(OtherStroke kind, Rng& rng);

}  // namespace daumier::datasets
