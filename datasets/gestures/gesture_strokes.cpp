#include "datasets/gestures/gesture_strokes.h"

#include "datasets/gestures/gesture_shapes.h"

#include "datasets/gestures/stroke_form.h"

#include <cmath>

namespace daumier::datasets {
namespace {

Polyline DrawGesture(Gesture gesture, const GestureHand& hand, Rng& rng) {
  Polyline stroke;
  do stroke = DrawWithHand(DrawGestureShape(gesture, rng), hand, rng);
  while (!KeepsDefinition(gesture, stroke));
  return stroke;
}

/// One that a hand spoils so that it is nearly straight or nearly closed is drawn again.
Polyline DrawOther(OtherStrokeKind kind, const GestureHand& hand, Rng& rng) {
  while (true) {
    Polyline stroke = DrawWithHand(DrawOtherShape(kind, rng), hand, rng);
    const StrokeForm form = FormOf(stroke);
    if (!form.is_nearly_straight() && !form.is_nearly_closed()) return stroke;
  }
}

}  // namespace

bool KeepsDefinition(Gesture gesture, const Polyline& stroke) {
  const StrokeForm form = FormOf(stroke);
  if (gesture == Gesture::kLine) return form.deviation <= 0.12;
  if (gesture == Gesture::kRegion) return form.gap <= 0.2;
  if (gesture < Gesture::kUpRoll1 || gesture == Gesture::kNone) return true;
  const int num_loops = 1 + (int(gesture) - int(Gesture::kUpRoll1)) % 3;
  return std::abs(std::abs(form.turns) - num_loops) <= 0.35;
}

std::vector<LabelledStroke> StrokesOfHand(const GestureHandOptions& options, const GestureCounts& counts, uint64_t seed,
                                          int hand) {
  Rng rng = Stream(seed, "gestures of a hand", uint64_t(hand));
  const GestureHand habits = DrawGestureHand(options, rng);
  std::vector<LabelledStroke> strokes;
  for (int gesture = 0; gesture < kNumGestures; ++gesture)
    for (int i = 0; i < counts.per_gesture; ++i)
      strokes.push_back(
          {.points = DrawGesture(Gesture(gesture), habits, rng), .gesture = Gesture(gesture), .hand = hand});
  for (int i = 0; i < counts.none; ++i) {
    const auto kind = OtherStrokeKind((i + hand) % kNumOtherStrokeKinds);
    strokes.push_back({.points = DrawOther(kind, habits, rng), .other = kind, .hand = hand});
  }
  return strokes;
}

}  // namespace daumier::datasets
