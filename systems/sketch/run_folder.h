#pragma once
#include "core/json.h"
#include "core/manifest.h"
#include "faces/face_model.h"
#include "render/camera.h"
#include "systems/sketch/fitted_models.h"
#include "systems/sketch/network_options.h"

#include <filesystem>
#include <string>
#include <vector>

namespace daumier::sketch {

/// `system` in the config and the manifest of a run.
inline constexpr const char* kSystem = "sketch";

/// All of a run folder but the weights:
///   manifest.json (kind "run", details.split = SplitToJson, details.sketches = {camera, feature_curves}),
///   resolved.toml (table `network` = SketchNetworkOptions; the data paths), template.{safetensors,json},
///   bilinear.safetensors, curves.safetensors, basis.safetensors (of networks with a residual),
///   gaussian.safetensors,
///   best/{model.safetensors,model.onnx}, checkpoints/latest/
struct SketchRunFolder {
  std::filesystem::path directory;
  Manifest manifest;
  Json config;  ///< resolved.toml
  faces::FaceTemplate face_template;
  FittedModels models;
  SketchNetworkOptions network_options;
  render::Camera camera;                    ///< Of the exact sketches that it was trained on.
  std::vector<std::string> feature_curves;  ///< The template's curves whose points models.curves holds, in its order.
};

/// @throws Error as ReadFinishedRun, and naming the file if one is malformed or disagrees with another.
SketchRunFolder ReadSketchRunFolder(const std::filesystem::path& directory);

}  // namespace daumier::sketch
