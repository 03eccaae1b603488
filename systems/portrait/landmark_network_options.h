#pragma once
#include "core/options.h"

namespace daumier::portrait {

/// The network that finds faces, landmarks and classes of pixels (models/heat_map_unet.h).
struct LandmarkNetworkOptions {
  int resolution = 128;
  int width = 16;
  int point_width = 48;
  double deviation = 1.0;

  template <class V>
  void Visit(V&& visit) {
    visit("resolution", resolution, Range{32, 512},
          "Side of the square crop that it reads, in pixels; a multiple of 16.");
    // A training with 8 channels ends within oneDNN 2.6 on processors with AVX-512.
    visit("width", width, Range{16, 64},
          "Channels at half of that side; a multiple of 8. Those of smaller maps scale with it.");
    visit("point_width", point_width, Range{8, 256}, "Channels from which heat maps are made; a multiple of 8.");
    visit("deviation", deviation, Range{0.3, 8},
          "Deviation of the Gaussian that a heat map has to show, in its cells.");
  }
};

}  // namespace daumier::portrait
