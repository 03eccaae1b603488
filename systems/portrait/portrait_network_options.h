#pragma once
#include "core/options.h"

namespace daumier::portrait {

/// The network that regresses the coefficients of a portrait, as models::ResidualNetworkOptions.
struct PortraitNetworkOptions {
  int depth = 50;
  int resolution = 224;
  int width = 64;

  template <class V>
  void Visit(V&& visit) {
    visit("depth", depth, Range{18, 50}, "Layers of the residual network: 18 or 50.");
    visit("resolution", resolution, Range{32, 512}, "Side of the picture that the network reads, a multiple of 32.");
    visit("width", width, Range{8, 128}, "Channels of the first convolution; 64 as published.");
  }
};

}  // namespace daumier::portrait
