#pragma once
#include "core/training.h"
#include "datasets/read/point_dataset.h"
#include "datasets/read/splits.h"
#include "systems/deform/network_options.h"

#include <string>

namespace daumier::deform {

struct DeformDataOptions {
  std::string faces, points;

  template <class V>
  void Visit(V&& visit) {
    visit("faces", faces, Text{}, "Folder of the faces.");
    visit("points", points, Text{}, "Folder of points on their surfaces.");
  }
};

struct DeformLossOptions {
  double data_weight = 3e3;
  double code_weight = 1e6;

  template <class V>
  void Visit(V&& visit) {
    visit("data_weight", data_weight, Range{1e-6, 1e12},
          "Weight of the mean squared error of the coordinates, in model units.");
    visit("code_weight", code_weight, Range{0, 1e12}, "Weight of the mean square of the numbers of the codes.");
  }
};

struct DeformValidationOptions {
  int faces = 14;
  int newton_steps = 6;

  template <class V>
  void Visit(V&& visit) {
    visit("faces", faces, Range{1, 100000}, "Number of validation faces, evenly spaced.");
    visit("newton_steps", newton_steps, Range{1, 1000},
          "Gauss-Newton steps that find the code of each validation face.");
  }
};

struct DeformTrainingOptions {
  std::string system = "deform";
  DeformDataOptions data;
  datasets::SplitOptions split;
  datasets::PointReading points;
  DeformOptions network;
  DeformLossOptions loss;
  DeformValidationOptions validation;
  OptimiserOptions optimiser{.learning_rate = 1e-4, .weight_decay = 0, .warm_up = 0, .final_rate = 1};
  TrainerOptions trainer;
  uint64_t seed = 1;

  template <class V>
  void Visit(V&& visit) {
    visit("system", system, Choices{{"deform"}}, "The task that is trained.");
    visit("data", data, Table{}, "Training data.");
    visit("split", split, Table{}, "Train/validation/test split.");
    visit("points", points, Table{}, "The points of a face that a step reads.");
    visit("network", network, Table{}, "The network.");
    visit("loss", loss, Table{}, "What is minimised.");
    visit("validation", validation, Table{}, "On which faces the best weights are chosen.");
    visit("optimiser", optimiser, Table{}, "The optimiser and its schedule.");
    trainer.Visit(visit);
    visit("seed", seed, Range{0, 9e15},
          "Seed of the split, the initial weights, the order of the faces and their points.");
  }
};

}  // namespace daumier::deform
