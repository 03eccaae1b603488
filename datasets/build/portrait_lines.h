#pragma once
#include "faces/appearance/portrait_head.h"
#include "render/camera.h"
#include "render/strokes.h"

#include <vector>

namespace daumier::datasets {

/// The ink lines of portraits: visible occluding contours of the face, and the visible parts of the annotation's lines
/// of nose, lids, lips and ears.
class PortraitLines {
 public:
  explicit PortraitLines(const faces::FaceTemplate& face_template);

  /// Strokes in pixels of the camera. The head's first vertices are the face's (V x 3, cm); all of the head hides lines.
  /// @throws Error as render::Rasterise.
  std::vector<render::Stroke> Draw(const faces::PortraitHead& head, const render::Camera& camera) const;

 private:
  geometry::Triangles triangles_;
  int num_vertices_;
  std::vector<std::vector<int>> curves_;  ///< Vertices; a closed curve ends with its first.
  double tolerance_;                      ///< cm
};

}  // namespace daumier::datasets
