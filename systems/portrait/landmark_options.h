#pragma once
#include "core/training.h"
#include "datasets/read/splits.h"
#include "systems/portrait/landmark_augmentation.h"
#include "systems/portrait/landmark_network_options.h"

#include <string>

namespace daumier::portrait {

struct LandmarkDataOptions {
  std::string portraits;

  template <class V>
  void Visit(V&& visit) {
    visit("portraits", portraits, Text{}, "Folder of the portraits.");
  }
};

struct LandmarkViewOptions {
  double hidden_weight = 0.5;
  double negative_share = 0.15;
  double scene_share = 0.25;

  template <class V>
  void Visit(V&& visit) {
    visit("hidden_weight", hidden_weight, Range{0, 1}, "Weight of landmarks that are hidden; seen ones weigh 1.");
    visit("negative_share", negative_share, Range{0, 0.9}, "Share of crops that show no face, or one of a wrong size.");
    visit("scene_share", scene_share, Range{0, 1},
          "Scenes to a crop: pictures of several faces or none, from which the search is learnt.");
  }
};

struct LandmarkLossOptions {
  double label_weight = 1.5;
  double state_weight = 0.3;
  double score_weight = 0.3;
  double box_weight = 0.3;
  double eye_class_weight = 16;
  double part_class_weight = 6;
  double background_class_weight = 0.5;

  template <class V>
  void Visit(V&& visit) {
    visit("label_weight", label_weight, Range{0, 100}, "Weight of the cross-entropy of pixels; heat maps weigh 1.");
    visit("state_weight", state_weight, Range{0, 100}, "Weight of the cross-entropy of states.");
    visit("score_weight", score_weight, Range{0, 100}, "Weight of the focal loss of boxes' centres.");
    visit("box_weight", box_weight, Range{0, 100}, "Weight of the absolute error of boxes.");
    visit("eye_class_weight", eye_class_weight, Range{0, 100}, "Weight of pixels of eyes; skin weighs 1.");
    visit("part_class_weight", part_class_weight, Range{0, 100}, "Weight of pixels of brows, lips, mouth and ears.");
    visit("background_class_weight", background_class_weight, Range{0, 100}, "Weight of pixels of the background.");
  }
};

struct LandmarkValidationOptions {
  int samples = 400;

  template <class V>
  void Visit(V&& visit) {
    visit("samples", samples, Range{1, 1e6}, "Number of validation portraits, evenly spaced.");
  }
};

struct LandmarkTrainingOptions {
  std::string system = "landmarks";
  LandmarkDataOptions data;
  datasets::SplitOptions split{.kind = "person", .validation = 0.05, .test = 0.05};
  LandmarkNetworkOptions network;
  LandmarkViewOptions views;
  LandmarkAugmentationOptions augmentation;
  LandmarkLossOptions loss;
  LandmarkValidationOptions validation;
  OptimiserOptions optimiser{.learning_rate = 3e-3, .weight_decay = 1e-3, .clip_norm = 5};
  TrainerOptions trainer;
  uint64_t seed = 1;

  template <class V>
  void Visit(V&& visit) {
    visit("system", system, Choices{{"landmarks"}}, "The task that is trained.");
    visit("data", data, Table{}, "Training data.");
    visit("split", split, Table{}, "Train/validation/test split.");
    visit("network", network, Table{}, "The network.");
    visit("views", views, Table{}, "What the network sees of a portrait.");
    visit("augmentation", augmentation, Table{}, "How views vary.");
    visit("loss", loss, Table{}, "What is minimised.");
    visit("validation", validation, Table{}, "On which portraits the best weights are chosen.");
    visit("optimiser", optimiser, Table{}, "The optimiser and its schedule.");
    trainer.Visit(visit);
    visit("seed", seed, Range{0, 9e15},
          "Seed of the split, the initial weights, the order of the samples and their views.");
  }
};

}  // namespace daumier::portrait
