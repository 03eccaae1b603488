#pragma once
#include "core/options.h"

#include <string>

namespace daumier::deform {

/// Where the data of a run are now.
struct DeformEvalData {
  std::string faces = {}, points = {};

  template <class V>
  void Visit(V&& visit) {
    visit("faces", faces, Text{}, "Folder of the faces that the run was trained on, if they have moved.");
    visit("points", points, Text{},
          "Folder of their points, if they have moved. Only its data hash is compared; an evaluation reads no points.");
  }
};

struct DeformEvalOptions {
  std::string split = "test";
  std::string faces = {};
  DeformEvalData data = {};
  int max_faces = 128;
  int adam_faces = 0;
  int adam_steps = 1000;
  bool baselines = true;

  template <class V>
  void Visit(V&& visit) {
    visit("split", split, Choices{{"test", "validation", "train"}}, "Subset of the run's split that is measured.");
    visit("faces", faces, Text{},
          "Folder of other faces of the same topology, on which the run was not trained. All of them are measured.");
    visit("data", data, Table{}, "The run's own data, found by their data hash.");
    visit("max_faces", max_faces, Range{1, 1e6}, "Largest number of measured faces, evenly spaced in the subset.");
    visit("adam_faces", adam_faces, Range{0, 1e6},
          "Number of faces, from the first one on, whose codes are also found by Adam as in the paper. Each takes "
          "adam_steps gradients over all of its vertices: minutes for eight faces of 1,000 steps.");
    visit("adam_steps", adam_steps, Range{1, 1e6}, "Adam steps for each of these codes.");
    visit("baselines", baselines, Flag{}, "Also measure the training-free baselines.");
  }
};

}  // namespace daumier::deform
