#pragma once
#include "core/training.h"
#include "datasets/read/splits.h"
#include "faces/source.h"
#include "systems/portrait/portrait_network_options.h"

#include <string>
#include <vector>

namespace daumier::portrait {

/// `system` in the config and the manifest of a run.
inline constexpr const char* kPortraitSystem = "portrait";

struct PortraitDataOptions {
  std::string faces, portraits;

  template <class V>
  void Visit(V&& visit) {
    visit("faces", faces, Text{}, "Folder of the faces that the portraits show.");
    visit("portraits", portraits, Text{}, "Folder of the portraits.");
  }
};

struct PortraitModelOptions {
  std::string identity = "components";

  template <class V>
  void Visit(V&& visit) {
    visit("identity", identity, Choices{{"components", "shapes"}},
          "Identity modes of the 3DMM. components: principal components of the training persons' neutral faces of all "
          "levels; shapes: the source's own first 80, of sources whose shapes are standard deviations (ict, bfm, "
          "flame).");
  }
};

struct PortraitPictureOptions {
  std::string crop = "landmarks";
  double size = 0.56;
  double shift = 10;
  double scale = 0.1;
  double rotation = 10;
  double colour = 0.1;
  std::vector<std::string> leave_out = {};

  template <class V>
  void Visit(V&& visit) {
    visit("crop", crop, Choices{{"landmarks", "none"}},
          "What the network sees of a picture. landmarks: the box of its landmarks has the same size and place in "
          "every crop; none: the whole picture.");
    visit("size", size, Range{0.2, 1}, "Longer side of the landmarks' box, as a share of the crop.");
    visit("shift", shift, Range{0, 60}, "Largest random shift of a training picture, pixels of 224.");
    visit("scale", scale, Range{0, 0.5}, "Largest random change of its size, as a share.");
    visit("rotation", rotation, Range{0, 45}, "Largest random rotation, degrees.");
    visit("colour", colour, Range{0, 0.5}, "Largest random change of the network's colours: brightness and contrast.");
    visit("leave_out", leave_out, Text{},
          "Styles of portraits that are not trained on; bald heads are the style \"bald\".");
  }
};

struct PortraitLossOptions {
  double landmarks = 2e-3;
  double photometric = 2.0;
  double regulariser = 3e-4;
  double identity = 1.2;
  double expression = 1.0;
  double albedo = 1.2e-3;
  double openings = 0;
  double reflectance = 0;
  double vertices = 0;
  double coefficients = 0;
  double angles = 0;
  double hidden = 1;
  std::string colours = "length";
  bool antialias = true;

  template <class V>
  void Visit(V&& visit) {
    visit("landmarks", landmarks, Range{0, 1e6}, "Weight of the landmark loss [Pan et al. 2024, eq. 3], pixels^2.");
    visit("photometric", photometric, Range{0, 1e6}, "Weight of the photometric loss; 0: nothing is rendered.");
    visit("regulariser", regulariser, Range{0, 1e6}, "Weight of the regulariser of coefficients.");
    visit("identity", identity, Range{0, 1e6}, "Weight of identity in the regulariser [eq. 6].");
    visit("expression", expression, Range{0, 1e6}, "Weight of expression in the regulariser.");
    visit("albedo", albedo, Range{0, 1e6}, "Weight of albedo in the regulariser.");
    visit("openings", openings, Range{0, 1e6},
          "Weight of the openings of eyes (1) and lips (0.5) [Feng et al. 2021], pixels; not in the paper.");
    visit("reflectance", reflectance, Range{0, 1e6},
          "Weight of the variance of the skin's albedo [Deng et al. 2019: 5]; not in the paper.");
    visit("vertices", vertices, Range{0, 1e6}, "Weight of the known vertices, cm^2: supervision; not in the paper.");
    visit("coefficients", coefficients, Range{0, 1e6},
          "Weight of the known expression, albedo and light: supervision; not in the paper.");
    visit("angles", angles, Range{0, 1e6}, "Weight of the known pitch, yaw and roll: supervision; not in the paper.");
    visit("hidden", hidden, Range{0, 1}, "Weight of landmarks that are hidden or outside of the picture.");
    visit("colours", colours, Choices{{"length", "squared"}},
          "Colour difference of the photometric loss: its length, as Deep3D's program, or its square, as printed.");
    visit("antialias", antialias, Flag{}, "Whether silhouettes of the rendered face are antialiased.");
  }
  bool renders() const { return photometric > 0; }
  /// Of a picture's face.
  bool reads_vertices() const { return vertices > 0; }
};

struct PortraitTrainingOptions {
  std::string system = kPortraitSystem;
  PortraitDataOptions data;
  std::string real = "";
  int max_images = 0;
  faces::SourceOptions source;
  datasets::SplitOptions split;
  PortraitModelOptions model;
  PortraitPictureOptions pictures;
  PortraitNetworkOptions network;
  PortraitLossOptions loss;
  int validation_images = 96;
  OptimiserOptions optimiser{.learning_rate = 1e-4, .weight_decay = 0};
  TrainerOptions trainer;
  uint64_t seed = 1;

  template <class V>
  void Visit(V&& visit) {
    visit("system", system, Choices{{kPortraitSystem}}, "The task that is trained.");
    visit("data", data, Table{}, "Training data.");
    visit("real", real, Text{},
          "Folder of pictures without known faces (daumier dataset portraits --images), trained on as well; may be "
          "empty.");
    visit("max_images", max_images, Range{0, 1e9}, "Largest number of training portraits, evenly spaced; 0: all.");
    visit("source", source, Table{}, "The source of the faces, for its expression shapes.");
    visit("split", split, Table{}, "Train/validation/test split of the persons.");
    visit("model", model, Table{}, "The 3DMM.");
    visit("pictures", pictures, Table{}, "What the network sees of a portrait.");
    visit("network", network, Table{}, "The network.");
    visit("loss", loss, Table{}, "What is minimised.");
    visit("validation_images", validation_images, Range{1, 1e6}, "Validation portraits, evenly spaced.");
    visit("optimiser", optimiser, Table{}, "The optimiser and its schedule.");
    trainer.Visit(visit);
    visit("seed", seed, Range{0, 9e15},
          "Seed of the split, the initial weights, the order of the portraits and their augmentation.");
  }
};

}  // namespace daumier::portrait
