#pragma once
#include "models/heat_map_unet.h"
#include "systems/portrait/landmark_run_folder.h"

namespace daumier::portrait {

/// A run folder with its network, as evaluation and export use it.
struct LandmarkRun : LandmarkRunFolder {
  models::HeatMapUnet network{nullptr};  ///< In evaluation mode, on the CPU, weights of best/, without gradients.
};

/// @throws Error as ReadLandmarkRunFolder, or if the weights are of another network.
LandmarkRun LoadLandmarkRun(const std::filesystem::path& directory);

}  // namespace daumier::portrait
