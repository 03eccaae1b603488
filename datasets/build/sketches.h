#pragma once
#include "core/options.h"
#include "faces/face_model.h"
#include "render/camera.h"

#include <filesystem>
#include <string>

namespace daumier::datasets {

struct SketchesOptions {
  std::string faces;
  std::string view = "frontal";
  double curve_height = 0.62;

  template <class V>
  void Visit(V&& visit) {
    visit("faces", faces, Text{}, "Folder of the faces that are drawn.");
    visit("view", view, Choices{{"frontal"}}, "From where; orthographic.");
    visit("curve_height", curve_height, Range{0.2, 1.0}, "Height of the mean head's curves as a share of the canvas.");
  }
};

/// One orthographic camera for all faces of a database: the frontal curves of the mean neutral face stand in the middle
/// of the canvas of render::kSketchCanvas pixels and take up `curve_height` of it; larger faces stay within the margin.
/// @throws Error if the template has no frontal curve.
render::Camera SketchCamera(const faces::FaceTemplate& face_template, double curve_height);

/// Writes a SketchDatabase: the annotation's frontal curves of every face of the database, as polylines through their
/// vertices; a closed curve repeats its first point. Goes on where an earlier, stopped build of the same options ended.
/// @throws Error as faces::FaceDatabase and BuildShards.
void BuildSketches(const SketchesOptions& options, const std::filesystem::path& directory);

}  // namespace daumier::datasets
