#pragma once
#include "models/heat_map_unet.h"
#include "systems/portrait/landmark_network_options.h"

namespace daumier::portrait {

/// The network of faces: 3 channels, 68 points, PictureClass labels, FaceState states of two classes, a search head.
/// Draws weights from LibTorch's CPU generator. @throws Error as models::HeatMapUnet, or if the resolution is no multiple
/// of 16.
models::HeatMapUnet MakeLandmarkNetwork(const LandmarkNetworkOptions& options);

}  // namespace daumier::portrait
