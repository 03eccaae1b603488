#pragma once
#include "models/heat_map_unet.h"
#include "systems/sketch/parser_network_options.h"

namespace daumier::sketch {

/// The network of drawings: 1 channel, faces::FacePoint points, faces::LineLabel labels, the states of
/// datasets::kDrawingStateNames, no search head. Draws weights from LibTorch's CPU generator. @throws Error as
/// models::HeatMapUnet, or if the resolution is no multiple of 16.
models::HeatMapUnet MakeParserNetwork(const ParserNetworkOptions& options);

}  // namespace daumier::sketch
