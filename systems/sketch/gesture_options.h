#pragma once
#include "core/training.h"
#include "systems/sketch/gesture_network_options.h"

#include <string>

namespace daumier::sketch {

struct GestureDataOptions {
  std::string gestures;

  template <class V>
  void Visit(V&& visit) {
    visit("gestures", gestures, Text{}, "Folder of the strokes (daumier dataset gestures).");
  }
};

struct GestureSplitOptions {
  double validation = 0.1;
  double test = 0.1;

  template <class V>
  void Visit(V&& visit) {
    visit("validation", validation, Range{0.001, 0.5},
          "Share of hands on whose strokes weights and the threshold of rejection are chosen.");
    visit("test", test, Range{0.001, 0.5}, "Share of hands for the test; only `daumier eval` reads their strokes.");
  }
};

struct GestureRejectionOptions {
  double accepted = 0.97;

  template <class V>
  void Visit(V&& visit) {
    visit("accepted", accepted, Range{0.5, 1},
          "Share of the validation strokes of the ten gestures that have to be accepted as some gesture: the threshold "
          "of the probability is the largest that does.");
  }
};

struct GestureTrainingOptions {
  std::string system = "gestures";
  GestureDataOptions data;
  GestureSplitOptions split;
  GestureNetworkOptions network;
  GestureRejectionOptions rejection;
  OptimiserOptions optimiser{.learning_rate = 2e-3, .weight_decay = 1e-2, .clip_norm = 5};
  TrainerOptions trainer{.epochs = 10, .batch = 64};
  uint64_t seed = 1;

  template <class V>
  void Visit(V&& visit) {
    visit("system", system, Choices{{"gestures"}}, "The task that is trained.");
    visit("data", data, Table{}, "Training data.");
    visit("split", split, Table{}, "Train/validation/test split, by hands.");
    visit("network", network, Table{}, "The network.");
    visit("rejection", rejection, Table{}, "Which strokes are no gesture.");
    visit("optimiser", optimiser, Table{}, "The optimiser and its schedule.");
    trainer.Visit(visit);
    visit("seed", seed, Range{0, 9e15}, "Seed of the split, the initial weights and the order of the samples.");
  }
};

}  // namespace daumier::sketch
