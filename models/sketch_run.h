#pragma once
#include "core/json.h"
#include "core/manifest.h"
#include "faces/bilinear_model.h"
#include "faces/face_model.h"
#include "models/sketch_network.h"

#include <filesystem>
#include <string>

namespace daumier::models {

/// A run folder read back: all that eval, export and predict need to use a trained sketch network.
///   manifest.json (kind "run", details.split = SplitToJson), resolved.toml (table `network` = PixelCnnOptions; the
///   data paths), template.{safetensors,json}, bilinear.safetensors, best/model.safetensors, checkpoints/latest/
struct SketchRun {
  std::filesystem::path directory;
  Manifest manifest;
  Json config;  ///< resolved.toml
  faces::FaceTemplate face_template;
  faces::BilinearModel bilinear;
  SketchNetwork network{nullptr};  ///< In evaluation mode, on the CPU, weights of best/.
};

/// @throws Error naming file and cause, and what to run, if the folder is not a finished sketch run: no manifest of
/// kind "run", no best weights, a file that is missing or differs from its checksum, or weights of another network.
SketchRun LoadSketchRun(const std::filesystem::path& directory);

}  // namespace daumier::models
