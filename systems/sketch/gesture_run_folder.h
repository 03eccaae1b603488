#pragma once
#include "core/json.h"
#include "core/manifest.h"
#include "systems/sketch/gesture_network_options.h"

#include <filesystem>

namespace daumier::sketch {

/// `system` in the config and the manifest of a run that classifies gestures.
inline constexpr const char* kGestureSystem = "gestures";

/// Which strokes are no gesture: those whose likeliest gesture has a probability below the threshold.
struct GestureRejection {
  double threshold = 0;
  double accepted = 1;  ///< Share of the validation strokes of the ten gestures that reach it.
};

Json RejectionToJson(const GestureRejection& rejection);
/// @throws Error naming `where` if it is malformed, or the threshold is no probability.
GestureRejection RejectionFromJson(const Json& json, const std::string& where);

/// All of a run folder but the weights:
///   manifest.json (kind "run", details.rejection once it is finished), resolved.toml (table `network` =
///   GestureNetworkOptions; the data path), best/{model.safetensors,model.onnx}, checkpoints/latest/
struct GestureRunFolder {
  std::filesystem::path directory;
  Manifest manifest;
  Json config;  ///< resolved.toml
  GestureNetworkOptions network_options;
};

/// @throws Error as ReadFinishedRun, and naming the file if one is malformed.
GestureRunFolder ReadGestureRunFolder(const std::filesystem::path& directory);

/// What a recogniser needs in addition to the network.
struct GestureDecision {
  GestureNetworkOptions network_options;
  GestureRejection rejection;
};
/// Of a finished run, or of shipped weights (details.network, details.rejection). @throws Error as ReadGestureRunFolder,
/// ReadWeights and RejectionFromJson.
GestureDecision ReadGestureDecision(const std::filesystem::path& run_or_weights);

}  // namespace daumier::sketch
