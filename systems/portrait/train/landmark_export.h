#pragma once
#include "export/run_export.h"
#include "models/heat_map_unet.h"

#include <filesystem>

namespace daumier::portrait {

/// The network as a function of `pictures` (N, 3, R, R) of 0..1 to `heat_maps` (N, 68, R / 4, R / 4), `labels`
/// (N, 8, R / 2, R / 2), `states` (N, 8) and `boxes` (N, 5, R / 8, R / 8), scores before any softmax
/// (models/heat_map_unet.h). resolution: R.
exporting::ExportedFunction LandmarkFunction(models::HeatMapUnet network, int resolution);

/// The network of shipped weights, without their numbers. network: LandmarkNetworkOptions. @throws Error as ParseOptions
/// and MakeLandmarkNetwork.
exporting::NetworkFunction MakeLandmarkFunction(const Json& network);

/// The export of a finished run. @throws Error as LoadLandmarkRun.
exporting::RunExport DescribeLandmarkExport(const std::filesystem::path& run_directory);

}  // namespace daumier::portrait
