#pragma once
#include "core/picture_parts.h"
#include "render/strokes.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace daumier::render {

/// What each pixel of a portrait shows, before a style draws it (G-buffers [Saito & Takahashi 1990]). All planes are
/// row-major, row 0 on top, H x W of the buffers: `supersampling` times the picture's size on each axis.
struct PictureBuffers {
  int height = 0, width = 0;
  int supersampling = 1;         ///< Pixels of the buffers a pixel of the picture and axis: 1, 2 or 3.
  float pixels_per_cm = 10.2f;   ///< Of the buffers, at the depth of the face. For shadows and occlusion.
  std::vector<float> albedo;     ///< H x W x 3, RGB in 0..1, display values.
  std::vector<float> normal;     ///< H x W x 3, unit, camera space: x right, y up, z to the viewer.
  std::vector<float> shade;      ///< H x W; colour = albedo * shade.
  std::vector<float> depth;      ///< H x W, cm, grows away from the viewer; infinite: background.
  std::vector<uint8_t> classes;  ///< H x W, PictureClass.
  std::vector<uint8_t> parts;    ///< H x W, PicturePart.
  std::vector<Stroke> lines;     ///< Ink lines in pixels of the buffers; may be empty.

  size_t size() const { return size_t(height) * width; }
  bool is_covered(size_t pixel) const { return depth[pixel] < kBackgroundDepth; }

  static constexpr float kBackgroundDepth = 1e9f;  ///< Cm; from here on a pixel is background.
};

/// Buffers of a size, all background: depth infinite, normals to the viewer, shade 1, the rest 0.
/// @throws Error if a size is not positive, supersampling is not 1 to 3, or the sizes are no multiples of it.
PictureBuffers EmptyPictureBuffers(int height, int width, int supersampling = 1);

/// @throws Error naming the plane whose size differs from height x width, a size or supersampling as above, a part or
/// class out of range, or pixels_per_cm that is not positive.
void CheckPictureBuffers(const PictureBuffers& buffers);

}  // namespace daumier::render
