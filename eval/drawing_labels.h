#pragma once
#include "faces/drawing_terms.h"

#include <Eigen/Core>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace daumier::eval {

/// A drawing of a face with points that a person set on it. Coordinates are those of render::ReadDrawings: pixels of
/// the picture, x to the right, y down, the corner of the first pixel at (0, 0); of Quick, Draw! those of its line.
struct LabelledDrawing {
  std::string name;                 ///< Of its prediction, NAME.obj.
  std::string group = {};           ///< "doodles" where it is of Quick, Draw! (.ndjson), else "pictures".
  std::filesystem::path file = {};  ///< Next to the file of labels; may be absent.
  int line = 1;                     ///< Which drawing of the file, from 1.
  bool usable = true;               ///< Whether it counts.
  double interocular = 0;           ///< Distance of the outer corners of the eyes, the unit of errors; 0: unknown.
  std::optional<faces::MouthState> mouth = {};
  std::optional<faces::EyeState> eyes = {};
  std::array<std::optional<Eigen::Vector2d>, faces::kNumFacePoints> points = {};

  bool is_scored() const { return usable && interocular > 0; }
};

/// The entry `drawings` of a JSON file: {NAME: {file, points: {POINT: [x, y] or null}, and where they are known usable,
/// interocular, mouth, eyes, line}}. Names of points and states are those of faces/drawing_terms.h.
/// @throws Error naming file, drawing and cause: malformed, an unknown name, no drawing, or a scored drawing with fewer
/// than two points that are no points of a contour.
std::vector<LabelledDrawing> ReadDrawingLabels(const std::filesystem::path& file);

}  // namespace daumier::eval
