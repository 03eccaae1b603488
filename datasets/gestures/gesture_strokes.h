#pragma once
#include "datasets/gestures/gesture.h"
#include "datasets/gestures/gesture_hand.h"
#include "datasets/gestures/other_strokes.h"

#include <optional>

namespace daumier::datasets {

/// A stroke with what it is.
struct LabelledStroke {
  Polyline points;  ///< Pixels of a screen, y down.
  Gesture gesture = Gesture::kNone;
  std::optional<OtherStrokeKind> other = {};  ///< Of kNone, where it is known.
  int hand = 0;                               ///< Who drew it.
};

/// How many strokes a hand draws.
struct GestureCounts {
  int per_gesture = 10;
  int none = 80;
};

/// Whether a stroke that was drawn as a gesture still is one by its measures: a line deviates by at most 0.12, the ends
/// of a region are at most 0.2 of its length from each other, a roll of n loops turns n times, 0.35 more or less. Always
/// true of arrows.
bool KeepsDefinition(Gesture gesture, const Polyline& stroke);

/// The strokes of a hand: of each gesture, then those that are none, kinds by turns. Each gesture keeps its definition: one
/// that a hand spoils is drawn again. A function of options, counts, seed
/// and hand alone. @throws UsageError as DrawGestureHand.
std::vector<LabelledStroke> StrokesOfHand(const GestureHandOptions& options, const GestureCounts& counts, uint64_t seed,
                                          int hand);

}  // namespace daumier::datasets
