#pragma once
#include "core/options.h"
#include "systems/sketch/drawing_fitter.h"

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
  bool styled = false;
  std::string recover_with = {};
  std::string faces = {}, sketches = {};
  SketchEvalData data = {};
  std::string parser = {};
  bool baselines = true, fit = false, refine = false, deform = false;
  int strokes = 0;
  DrawingFitOptions fitting = {};

  template <class V>
  void Visit(V&& visit) {
    visit("split", split, Choices{{"train", "validation", "test"}}, "Subset of the run's split that is measured.");
    visit("strength", strength, Range{0, 4},
          "Strength of the augmentation of the sketches: 0 none, 1 as in training, 2 strong.");
    visit(
        "styled", styled, Flag{},
        "Draw the sketches in styles of people (docs/drawing_styles.md), as the run's option sketch.styled has them.");
    visit("recover_with", recover_with, Text{},
          "For a network that reads curve coefficients: folder of another run on the same data whose network reads "
          "none. The coefficients are then also recovered from the faces of that run. Empty: given coefficients only.");
    visit("faces", faces, Text{},
          "Folder of other faces, on which the run was not trained. All of them are measured, instead of a subset of "
          "the run's split.");
    visit("sketches", sketches, Text{}, "Folder of the sketches of these other faces.");
    visit("data", data, Table{}, "The run's own data, found by their data hash.");
    visit("baselines", baselines, Flag{},
          "Also measure the training-free baselines and the limit of the model (its projection error). They depend on "
          "data, split and strength only. With other faces: also measure ridge regression and the nearest neighbour, "
          "fitted on the run's training faces; mean face and limit of the model are then always measured.");
    visit("fit", fit, Flag{}, "Also fit the bilinear model to the labelled strokes, with and without its prior.");
    visit("refine", refine, Flag{},
          "Also match the contours of the network's faces with the strokes. With other faces this is always done.");
    visit("deform", deform, Flag{},
          "Also fit the network's faces to the sketches as a parser of drawings reads them, without labels. With other "
          "faces this is always done.");
    visit("parser", parser, Text{},
          "Run or weights of the task drawing_parser, for fits. Empty: those in the shipped weights.");
    visit(
        "strokes", strokes, Range{0, 100000},
        "Number of evenly spaced faces whose drawings, in styles of people, are also measured after their first 1, 2, "
        "3, 4, 6, 8, 12, 16, 24, 32 and all strokes, and a fifth of them after each stroke. 0: none.");
    visit("fitting", fitting, Table{}, "How faces are fitted to parsed drawings by `strokes`.");
  }
};

/// @throws UsageError if faces come without their sketches, or if other faces are to be measured in a way that is for a
/// subset of the run's split alone.
void CheckEvalOptions(const SketchEvalOptions& options);

}  // namespace daumier::sketch
