#pragma once
#include "core/options.h"

#include <string>

namespace daumier::sketch {

/// Of an evaluation on one side of the run's split.
struct SketchEvalOptions {
  std::string split = "test";
  double strength = 0;
  std::string recover_with = {};
  bool baselines = true, fit = false, refine = false, deform = false;

  template <class V>
  void Visit(V&& visit) {
    visit("split", split, Choices{{"train", "validation", "test"}}, "The side of the run's split that is measured.");
    visit("strength", strength, Range{0, 4}, "Augment the sketches: 0 not, 1 as in training, 2 strongly.");
    visit("recover_with", recover_with, Text{},
          "Folder of another run on the same data, whose network reads no shape-level numbers: its faces are where a "
          "network that does read them gets recovered ones from. Empty: such a network is given them alone.");
    visit("baselines", baselines, Flag{},
          "Measure the free baselines and the limit of the model beside the network; they depend on data, split and "
          "strength alone.");
    visit("fit", fit, Flag{}, "Also fit the bilinear model to the labelled strokes, with and without its prior.");
    visit("refine", refine, Flag{}, "Also match the contours of the network's faces with the strokes.");
    visit("deform", deform, Flag{}, "Also do that and then move the faces' surfaces onto the strokes.");
  }
};

/// Of an evaluation on an external face database.
struct OtherFacesOptions {
  std::string faces, sketches;
  double strength = 0;
  bool baselines = true;

  template <class V>
  void Visit(V&& visit) {
    visit("faces", faces, Text{}, "Folder of faces that the run was not trained on; all of them are measured.");
    visit("sketches", sketches, Text{}, "Folder of their sketches.");
    visit("strength", strength, Range{0, 4}, "Augment the sketches: 0 not, 1 as in training, 2 strongly.");
    visit("baselines", baselines, Flag{},
          "Of exact sketches, ridge regression and nearest neighbour, fitted on the run's training faces.");
  }
};

}  // namespace daumier::sketch
