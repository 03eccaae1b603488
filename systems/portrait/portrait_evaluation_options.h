#pragma once
#include "core/options.h"

#include <string>

namespace daumier::portrait {

/// Where the data of a run are now.
struct PortraitEvalData {
  std::string faces = {}, portraits = {};

  template <class V>
  void Visit(V&& visit) {
    visit("faces", faces, Text{}, "Folder of the faces that the run was trained on, if they have moved.");
    visit("portraits", portraits, Text{}, "Folder of their portraits, if they have moved.");
  }
};

struct PortraitEvalOptions {
  std::string split = "test";
  PortraitEvalData data = {};
  int max_images = 200;
  int refined_images = 40;
  int refinement_steps = 25;
  bool baselines = true;
  std::string pictures = {};
  std::string detected = {};

  template <class V>
  void Visit(V&& visit) {
    visit("split", split, Choices{{"test", "validation", "train"}}, "Subset of the run's split that is measured.");
    visit("data", data, Table{}, "The run's own data, found by their data hash.");
    visit("max_images", max_images, Range{1, 1e6},
          "Largest number of measured portraits, evenly spaced in the subset.");
    visit("refined_images", refined_images, Range{0, 1e6},
          "Number of portraits, the first ones, that are also refined through the renderer.");
    visit("refinement_steps", refinement_steps, Range{1, 1000}, "Steps of a refinement; each takes about 10 ms.");
    visit("baselines", baselines, Flag{}, "Also measure the mean face and the landmark fit, which need no training.");
    visit("pictures", pictures, Text{},
          "Folder of pictures with landmark files of the same name (.txt, .pts, .json), on which the landmarks of the "
          "predicted faces are measured as well.");
    visit("detected", detected, Text{},
          "Folder of landmark files that a detector wrote (NAME.txt, .pts or .json of each of the pictures, and of "
          "portrait "
          "i its number): the crops, the landmark fit and the refinement are also measured with them.");
  }
};

}  // namespace daumier::portrait
