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
    visit("points", points, Text{}, "Folder of their points; an evaluation compares its data hash and reads no point.");
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
    visit("split", split, Choices{{"test", "validation", "train"}}, "The subset of the run's split that is measured.");
    visit("faces", faces, Text{},
          "Folder of other faces of the same topology, which the run was not trained on; all of them are measured.");
    visit("data", data, Table{}, "The run's own data, found by their data hash.");
    visit("max_faces", max_faces, Range{1, 1e6}, "Largest number of faces of the subset, evenly spaced.");
    visit("adam_faces", adam_faces, Range{0, 1e6},
          "Number of faces, the first ones, whose codes are also found as in the paper, by Adam. Each takes adam_steps "
          "gradients over all of its vertices: minutes for eight faces of 1,000 steps.");
    visit("adam_steps", adam_steps, Range{1, 1e6}, "Steps of that for each face.");
    visit("baselines", baselines, Flag{}, "Also measure the training-free baselines.");
  }
};

}  // namespace daumier::deform
