#pragma once
#include "faces/face_model.h"
#include "render/camera.h"

#include <filesystem>
#include <string>

namespace daumier::cli {

/// The template of predicted meshes, and the camera that projects them onto the canvas of their drawings.
struct ScoreTemplate {
  faces::FaceTemplate face_template;
  render::Camera camera;  ///< Of the sketches that a run was trained on; else the sketch camera of the template.
};

/// `named`: a run, weights (a folder or a shipped name) or a folder of faces. Empty: the weights that the manifest of
/// the predictions names. A warning says if predictions are of another run.
/// @throws UsageError if there is no template there, or nothing names one; Error as faces::ReadFaceTemplate.
ScoreTemplate ReadScoreTemplate(const std::string& named, const std::filesystem::path& predictions);

}  // namespace daumier::cli
