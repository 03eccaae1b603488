#pragma once
#include "core/training.h"
#include "datasets/read/sketch_variation.h"
#include "datasets/read/splits.h"
#include "faces/bilinear_model.h"
#include "faces/face_gaussian.h"
#include "systems/sketch/network_options.h"

#include <string>

namespace daumier::sketch {

struct SketchDataOptions {
  std::string faces, sketches;

  template <class V>
  void Visit(V&& visit) {
    visit("faces", faces, Text{}, "Folder of the faces.");
    visit("sketches", sketches, Text{}, "Folder of their sketches.");
  }
};

/// The three steps of training [Han et al. 2017, section 4.4]; what is left of 1 is the last one, tuning by the vertex
/// loss.
struct SketchStageOptions {
  double classification = 0;
  double regression = 0;
  double classification_rate = 1;
  double regression_rate = 1;
  double tuning_rate = 1;

  template <class V>
  void Visit(V&& visit) {
    visit("classification", classification, Range{0, 1},
          "Share of all steps, at the beginning, in which identities (a person at a level) and expressions are "
          "classified.");
    visit("regression", regression, Range{0, 1},
          "Share of all steps, after these, in which u and v are regressed while the convolutions are frozen. The last "
          "steps tune all weights by the vertex loss.");
    visit("classification_rate", classification_rate, Range{0, 1},
          "Factor of the learning rate in the steps of classification.");
    visit("regression_rate", regression_rate, Range{0, 1}, "Factor of the learning rate in the steps of regression.");
    visit("tuning_rate", tuning_rate, Range{0, 1}, "Factor of the learning rate in the last steps.");
  }
};

struct SketchTrainingOptions {
  std::string system = "sketch";
  SketchDataOptions data;
  datasets::SplitOptions split;
  faces::BilinearOptions bilinear;
  faces::FaceGaussianOptions gaussian;
  datasets::SketchVariation sketch;
  SketchNetworkOptions network;
  SketchStageOptions stages;
  OptimiserOptions optimiser;
  TrainerOptions trainer;
  std::string loss = "gram";
  double curve_weight = 2;
  uint64_t seed = 1;

  template <class V>
  void Visit(V&& visit) {
    visit("system", system, Choices{{"sketch"}}, "The task that is trained.");
    visit("data", data, Table{}, "Training data.");
    visit("split", split, Table{}, "Train/validation/test split.");
    visit("bilinear", bilinear, Table{}, "The bilinear models of faces and curves, fitted on training faces.");
    visit("gaussian", gaussian, Table{},
          "The normal distribution of training faces, from which a fit to a drawing starts.");
    visit("sketch", sketch, Table{}, "Which sketch of a face is seen.");
    visit("network", network, Table{}, "The network.");
    visit("stages", stages, Table{}, "The three steps of training.");
    visit("optimiser", optimiser, Table{}, "The optimiser and its schedule.");
    trainer.Visit(visit);
    visit("loss", loss, Choices{{"gram", "vertices"}},
          "How the vertex loss is computed. gram: as a quadratic form of the coefficients, without reading a vertex in "
          "a step; vertices: from the vertices. Both give the same number.");
    visit("curve_weight", curve_weight, Range{1, 1000},
          "Weight of the vertices of feature curves in the vertex loss; all others weigh 1.");
    visit("seed", seed, Range{0, 9e15},
          "Seed of the split, the initial weights, the order of the samples and their augmentation.");
  }
};

}  // namespace daumier::sketch
