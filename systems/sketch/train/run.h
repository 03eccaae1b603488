#pragma once
#include "core/json.h"
#include "core/manifest.h"
#include "faces/bilinear_model.h"
#include "faces/face_model.h"
#include "systems/sketch/train/network.h"
#include "render/camera.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace daumier::sketch {

/// A run folder read back: all that eval, export and predict need to use a trained sketch network.
///   manifest.json (kind "run", details.split = SplitToJson, details.sketches = {camera, feature_curves}),
///   resolved.toml (table `network` = SketchNetworkOptions; the data paths), template.{safetensors,json},
///   bilinear.safetensors, curves.safetensors, basis.safetensors (of networks with a residual), best/model.safetensors,
///   checkpoints/latest/
struct SketchRun {
  std::filesystem::path directory;
  Manifest manifest;
  Json config;  ///< resolved.toml
  faces::FaceTemplate face_template;
  FittedModels models;
  render::Camera camera;                    ///< Of the exact sketches that it was trained on.
  std::vector<std::string> feature_curves;  ///< The template's curves whose points models.curves holds, in its order.
  SketchNetwork network{nullptr};           ///< In evaluation mode, on the CPU, weights of best/.
};

/// Files of the fitted models, which train/ writes, as names and checksums in a folder of a run.
std::map<std::string, std::string> WriteFittedModels(const std::filesystem::path& directory,
                                                     const FittedModels& models);
/// Undoes WriteFittedModels; the basis is empty where there is none. @throws Error naming file and cause.
FittedModels ReadFittedModels(const std::filesystem::path& directory);

/// @throws Error naming file and cause, and what to run, if the folder is not a finished sketch run: no manifest of
/// kind "run", no best weights, a file that is missing or differs from its checksum, or weights of another network.
SketchRun LoadSketchRun(const std::filesystem::path& directory);

}  // namespace daumier::sketch
