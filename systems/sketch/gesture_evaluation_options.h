#pragma once
#include "core/options.h"

#include <cstdint>
#include <string>

namespace daumier::sketch {

/// Where the data of a run are now.
struct GestureEvalData {
  std::string gestures = {};

  template <class V>
  void Visit(V&& visit) {
    visit("gestures", gestures, Text{}, "Folder of the strokes that the run was trained on, if it has moved.");
  }
};

struct GestureEvalOptions {
  std::string strokes = "run";
  std::string split = "test";
  GestureEvalData data = {};
  int per_gesture = 100;
  int none = 1000;
  std::string drawings = {};
  uint64_t seed = 1;

  template <class V>
  void Visit(V&& visit) {
    visit("strokes", strokes, Choices{{"run", "independent"}},
          "run: those of the run's data. independent: of another generator, with which nothing is trained "
          "(datasets/gestures/test_gestures.h).");
    visit("seed", seed, Range{0, 9e15}, "Seed of independent strokes.");
    visit("split", split, Choices{{"train", "validation", "test"}}, "Subset of the run's split that is measured.");
    visit("data", data, Table{}, "The run's own data, found by their data hash.");
    visit("per_gesture", per_gesture, Range{1, 1e6}, "Most strokes of a gesture that are measured, evenly spaced.");
    visit("none", none, Range{0, 1e6}, "Most strokes that are none that are measured, evenly spaced.");
    visit("drawings", drawings, Text{},
          "File of drawings by people, whose strokes count in addition as none of the gestures, but for those that are "
          "nearly straight or nearly closed.");
  }
};

}  // namespace daumier::sketch
