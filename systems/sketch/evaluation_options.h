#pragma once
#include "core/options.h"

#include <string>

namespace daumier::sketch {

/// Where the data of a run are now.
struct SketchEvalData {
  std::string faces = {}, sketches = {};

  template <class V>
  void Visit(V&& visit) {
    visit("faces", faces, Text{}, "Folder of the faces that the run was trained on, if they have moved.");
    visit("sketches", sketches, Text{}, "Folder of their sketches, if they have moved.");
  }
};

struct SketchEvalOptions {
  std::string split = "test";
  double strength = 0;
  std::string recover_with = {};
  std::string faces = {}, sketches = {};
  SketchEvalData data = {};
  bool baselines = true, fit = false, refine = false, deform = false;

  template <class V>
  void Visit(V&& visit) {
    visit("split", split, Choices{{"train", "validation", "test"}}, "The subset of the run's split that is measured.");
    visit("strength", strength, Range{0, 4}, "Augment the sketches: 0 not, 1 as in training, 2 strongly.");
    visit("recover_with", recover_with, Text{},
          "Folder of another run on the same data whose network reads no curve coefficients. A network that reads them "
          "gets those recovered from that run's faces. Empty: it gets given ones only.");
    visit("faces", faces, Text{},
          "Folder of faces that the run was not trained on, in place of a subset of its split; all are measured.");
    visit("sketches", sketches, Text{}, "Folder of the sketches of these faces.");
    visit("data", data, Table{}, "The run's own data, found by their data hash.");
    visit("baselines", baselines, Flag{},
          "Also measure the training-free baselines and the upper bound of the model. They depend on data, split and "
          "strength only. Of other faces: those that read the run's training faces.");
    visit("fit", fit, Flag{}, "Also fit the bilinear model to the labelled strokes, with and without its prior.");
    visit("refine", refine, Flag{},
          "Also match the contours of the network's faces with the strokes; of other faces always done.");
    visit("deform", deform, Flag{},
          "Also do that and then move the faces' surfaces onto the strokes; of other faces always done.");
  }
};

/// @throws UsageError if faces come without their sketches, or if other faces are to be measured in a way that is for a
/// subset of the run's split alone.
void CheckEvalOptions(const SketchEvalOptions& options);

}  // namespace daumier::sketch
