#pragma once
#include "core/json.h"
#include "core/manifest.h"
#include "faces/face_model.h"
#include "systems/deform/network_options.h"

#include <filesystem>

namespace daumier::deform {

/// `system` in the config and the manifest of a run.
inline constexpr const char* kSystem = "deform";

/// All of a run folder but the weights:
///   manifest.json (kind "run", details.split = SplitToJson, details.training_faces),
///   resolved.toml (tables `network` = DeformOptions and `loss`; the data paths), template.{safetensors,json},
///   best/model.safetensors (weights, template_vertices, model_from_cm, codes), best/model.onnx, checkpoints/latest/
struct DeformRunFolder {
  std::filesystem::path directory;
  Manifest manifest;
  Json config;  ///< resolved.toml
  faces::FaceTemplate face_template;
  DeformOptions network_options;
  double data_weight = 0, code_weight = 0;  ///< Of the energy that codes minimise: `loss` of the config.

  /// Whether it is another program's model (ImportAuthorsModel), without faces and points of its own.
  bool is_imported() const { return manifest.details.contains("imported"); }
};

/// @throws Error as ReadFinishedRun, and naming the file if one is malformed.
DeformRunFolder ReadDeformRunFolder(const std::filesystem::path& directory);

}  // namespace daumier::deform
