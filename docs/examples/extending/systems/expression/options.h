#pragma once
#include "core/training.h"
#include "datasets/read/splits.h"

#include <string>

namespace daumier::expression {

/// `system` in the config and the manifest of a run.
inline constexpr const char* kSystem = "expression";

struct FacesFolder {
  std::string faces;

  template <class V>
  void Visit(V&& visit) {
    visit("faces", faces, Text{}, "Folder of the faces.");
  }
};

struct NetworkOptions {
  int hidden = 32;

  template <class V>
  void Visit(V&& visit) {
    visit("hidden", hidden, Range{1, 4096}, "Neurons of the layer between vertices and scores.");
  }
};

struct TrainingOptions {
  std::string system = kSystem;
  FacesFolder data;
  datasets::SplitOptions split;
  NetworkOptions network;
  OptimiserOptions optimiser;
  TrainerOptions trainer{.epochs = 30, .batch = 16};
  uint64_t seed = 1;

  template <class V>
  void Visit(V&& visit) {
    visit("system", system, Choices{{kSystem}}, "The task that is trained.");
    visit("data", data, Table{}, "Training data.");
    visit("split", split, Table{}, "Train/validation/test split.");
    visit("network", network, Table{}, "The network.");
    visit("optimiser", optimiser, Table{}, "The optimiser and its schedule.");
    trainer.Visit(visit);
    visit("seed", seed, Range{0, 9e15}, "Seed of the split, the initial weights and the order of the samples.");
  }
};

struct EvalOptions {
  std::string split = "test";
  FacesFolder data;

  template <class V>
  void Visit(V&& visit) {
    visit("split", split, Choices{{"train", "validation", "test"}}, "Subset of the run's split that is measured.");
    visit("data", data, Table{}, "The run's own faces, if they have moved.");
  }
};

struct PredictOptions {
  template <class V>
  void Visit(V&&) {}
};

}  // namespace daumier::expression
