#pragma once
#include "core/options.h"
#include "core/task.h"
#include "datasets/gestures/gesture_hand.h"

#include <cstdint>
#include <filesystem>

namespace daumier::datasets {

struct GesturesOptions {
  int num_hands = 300;
  int per_gesture = 8;
  int none = 80;
  GestureHandOptions hand;
  uint64_t seed = 1;

  template <class V>
  void Visit(V&& visit) {
    visit("num_hands", num_hands, Range{1, 1e6}, "Number of persons who draw, each with habits.");
    visit("per_gesture", per_gesture, Range{0, 1e5}, "Strokes of each of the ten gestures that a hand draws.");
    visit("none", none, Range{0, 1e6}, "Strokes that are no gesture, of all kinds by turns, that a hand draws.");
    visit("hand", hand, Table{}, "How people draw.");
    visit("seed", seed, Range{0, 9e15}, "Seed of all random numbers.");
  }
};

/// Writes a GestureDatabase of StrokesOfHand, and examples.png, a sheet of the first ones of each kind. Resumes an
/// interrupted build of the same options. @throws UsageError if hands draw nothing, or as DrawGestureHand; Error as
/// BuildShards.
void BuildGestures(const GesturesOptions& options, const std::filesystem::path& directory, const Task& task = {});

}  // namespace daumier::datasets
