#pragma once
#include "core/json.h"
#include "core/manifest.h"
#include "systems/portrait/landmark_network_options.h"

#include <filesystem>

namespace daumier::portrait {

/// `system` in the config and the manifest of a run that finds landmarks.
inline constexpr const char* kLandmarkSystem = "landmarks";

/// All of a run folder but the weights:
///   manifest.json (kind "run", details.split = SampleSplitToJson),
///   resolved.toml (table `network` = LandmarkNetworkOptions; the data path),
///   best/{model.safetensors,model.onnx}, checkpoints/latest/
struct LandmarkRunFolder {
  std::filesystem::path directory;
  Manifest manifest;
  Json config;  ///< resolved.toml
  LandmarkNetworkOptions network_options;
};

/// @throws Error as ReadFinishedRun, and naming the file if one is malformed.
LandmarkRunFolder ReadLandmarkRunFolder(const std::filesystem::path& directory);

/// Of a finished run, or of shipped weights (details.network). @throws Error as ReadLandmarkRunFolder and ReadWeights.
LandmarkNetworkOptions ReadLandmarkNetworkOptions(const std::filesystem::path& run_or_weights);

}  // namespace daumier::portrait
