#pragma once
#include "faces/face_model.h"
#include "render/camera.h"
#include "render/strokes.h"
#include "render/styles/picture_buffers.h"

#include <vector>

namespace daumier::datasets {

/// The ink lines of portraits: visible occluding contours of the face, and the visible parts of the annotation's lines
/// of nose, lids, lips and ears.
class PortraitLines {
 public:
  explicit PortraitLines(const faces::FaceTemplate& face_template);

  /// Strokes in pixels of the camera, hidden where `buffers`, of that camera's size, show something nearer. `face`:
  /// V x 3, cm. @throws Error if a size differs.
  std::vector<render::Stroke> Draw(const geometry::Points& face, const render::Camera& camera,
                                   const render::PictureBuffers& buffers) const;

 private:
  geometry::Triangles triangles_;
  std::vector<std::vector<int>> curves_;  ///< Vertices; a closed curve ends with its first.
  double tolerance_;                      ///< cm
};

}  // namespace daumier::datasets
