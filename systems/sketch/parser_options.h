#pragma once
#include "core/no_data.h"
#include "core/training.h"
#include "datasets/read/splits.h"
#include "datasets/styles/styled_dataset.h"
#include "systems/sketch/parser_network_options.h"

#include <string>

namespace daumier::sketch {

struct ParserDataOptions {
  std::string faces, sketches;
  std::string profiles = kNoData;

  template <class V>
  void Visit(V&& visit) {
    visit("faces", faces, Text{}, "Folder of the faces.");
    visit("sketches", sketches, Text{}, "Folder of their sketches.");
    visit("profiles", profiles, Text{}, "Folder of their sketches from the side; none: without profiles.");
  }
};

struct ParserLossOptions {
  double label_weight = 1.5;
  double state_weight = 1.5;
  double view_weight = 0.5;
  double hair_class_weight = 0.3;
  double other_class_weight = 0.5;
  double part_class_weight = 3;

  template <class V>
  void Visit(V&& visit) {
    visit("label_weight", label_weight, Range{0, 100}, "Weight of the cross-entropy of labels; heat maps weigh 1.");
    visit("state_weight", state_weight, Range{0, 100}, "Weight of the cross-entropy of states of mouth and eyes.");
    visit("view_weight", view_weight, Range{0, 100},
          "Weight of the cross-entropy of the view, relative to that of states.");
    visit("hair_class_weight", hair_class_weight, Range{0, 100}, "Weight of cells of hair; the silhouette weighs 1.");
    visit("other_class_weight", other_class_weight, Range{0, 100}, "Weight of cells of neck and other lines.");
    visit("part_class_weight", part_class_weight, Range{0, 100},
          "Weight of cells of eyes, brows, nose, mouth and ears.");
  }
};

/// Sketches of faces that a parser reads: one in kProfileEvery faces is also seen from the side.
struct ParserSketches {
  const datasets::SketchDatabase& sketches;
  const datasets::SketchDatabase* profiles = nullptr;
};
inline constexpr size_t kProfileEvery = 10;

struct ParserValidationOptions {
  int samples = 400;

  template <class V>
  void Visit(V&& visit) {
    visit("samples", samples, Range{1, 1e6}, "Number of drawings of validation faces, evenly spaced.");
  }
};

struct ParserTrainingOptions {
  std::string system = "drawing_parser";
  ParserDataOptions data;
  datasets::SplitOptions split{.kind = "person", .validation = 0.05, .test = 0.1};
  ParserNetworkOptions network;
  datasets::StyledReading drawings;
  ParserLossOptions loss;
  ParserValidationOptions validation;
  OptimiserOptions optimiser{.learning_rate = 2e-3, .weight_decay = 1e-3, .clip_norm = 5};
  TrainerOptions trainer;
  uint64_t seed = 1;

  template <class V>
  void Visit(V&& visit) {
    visit("system", system, Choices{{"drawing_parser"}}, "The task that is trained.");
    visit("data", data, Table{}, "Training data.");
    visit("split", split, Table{}, "Train/validation/test split.");
    visit("network", network, Table{}, "The network.");
    visit("drawings", drawings, Table{}, "How sketches are drawn in styles of people.");
    visit("loss", loss, Table{}, "What is minimised.");
    visit("validation", validation, Table{}, "On which drawings the best weights are chosen.");
    visit("optimiser", optimiser, Table{}, "The optimiser and its schedule.");
    trainer.Visit(visit);
    visit("seed", seed, Range{0, 9e15},
          "Seed of the split, the initial weights, the order of the samples and their drawings.");
  }
};

}  // namespace daumier::sketch
