#pragma once
#include "core/options.h"
#include "datasets/gestures/gesture_raster.h"

#include <string>

namespace daumier::sketch {

/// The network that classifies pen gestures.
struct GestureNetworkOptions {
  std::string kind = "compact";

  template <class V>
  void Visit(V&& visit) {
    visit("kind", kind, Choices{{"compact", "paper"}},
          "paper: as printed in DeepSketch2Face, of a binary picture of 256 x 256. compact: of a picture of 80 x 80, "
          "fast on a CPU.");
  }

  datasets::GestureRaster raster() const {
    if (kind == "paper") return {.side = 256, .width = 3, .binary = true};
    return {.side = 80, .width = 1.5, .binary = false};
  }
};

}  // namespace daumier::sketch
