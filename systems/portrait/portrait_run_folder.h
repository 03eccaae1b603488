#pragma once
#include "core/json.h"
#include "core/manifest.h"
#include "faces/morphable_model.h"
#include "systems/portrait/portrait_options.h"

#include <filesystem>

namespace daumier::portrait {

/// All of a run folder but the weights:
///   manifest.json (kind "run", details.split of the persons), resolved.toml, the 3DMM (faces::WriteMorphableFiles),
///   best/model.safetensors, best/model.onnx (crop -> coefficients), checkpoints/latest/
struct PortraitRunFolder {
  std::filesystem::path directory;
  Manifest manifest;
  Json config;  ///< resolved.toml
  faces::MorphableModel model;
  PortraitTrainingOptions options;
};

/// @throws Error as ReadFinishedRun and faces::ReadMorphableModel, and naming the file if the config is malformed.
PortraitRunFolder ReadPortraitRunFolder(const std::filesystem::path& directory);

}  // namespace daumier::portrait
