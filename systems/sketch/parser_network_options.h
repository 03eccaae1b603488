#pragma once
#include "core/options.h"

namespace daumier::sketch {

/// The network that parses drawings (models/heat_map_unet.h): heat maps have a quarter of the picture's side, labels a
/// half.
struct ParserNetworkOptions {
  int resolution = 256;
  int width = 16;
  int point_width = 48;
  double deviation = 1.2;

  template <class V>
  void Visit(V&& visit) {
    visit("resolution", resolution, Range{64, 512},
          "Side of the square picture that it reads, in pixels; a multiple of 16.");
    visit("width", width, Range{16, 64},
          "Channels at half of that side; a multiple of 8. Those of smaller maps scale with it.");
    visit("point_width", point_width, Range{16, 256}, "Channels from which heat maps are made; a multiple of 8.");
    visit("deviation", deviation, Range{0.3, 8},
          "Deviation of the Gaussian that a heat map has to show, in its cells.");
  }

  int map_side() const { return resolution / 4; }
  int label_side() const { return resolution / 2; }
};

}  // namespace daumier::sketch
