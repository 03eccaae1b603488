#pragma once
#include "render/image.h"

#include <array>
#include <cstddef>
#include <vector>

namespace daumier::render {

/// One number a pixel: H x W floats, row-major.
struct Plane {
  int height = 0, width = 0;
  std::vector<float> values;

  Plane() = default;
  Plane(int plane_height, int plane_width, float value = 0)
      : height(plane_height), width(plane_width), values(size_t(plane_height) * plane_width, value) {}
  float& at(int row, int column) { return values[size_t(row) * width + column]; }
  float at(int row, int column) const { return values[size_t(row) * width + column]; }
  float* row(int index) { return values.data() + size_t(index) * width; }
  const float* row(int index) const { return values.data() + size_t(index) * width; }
};

/// A colour picture as three planes R, G, B; display values, 0..1 but not clamped.
using ColourPlanes = std::array<Plane, 3>;
ColourPlanes MakeColourPlanes(int height, int width, const std::array<float, 3>& colour);

/// 0.299 R + 0.587 G + 0.114 B, a row of weights that sum to 1 [ITU-R BT.601].
Plane Luma(const ColourPlanes& colours);

/// Clamped to 0..1, times 255, rounded. Undoes ToPlanes.
Image ToImage(const ColourPlanes& colours);
ColourPlanes ToPlanes(const Image& image);  ///< Grey pictures give three equal planes.

/// Mean over the pixels within `radius` on each axis, of those that are in the picture: running sums, so that the cost
/// does not depend on the radius. Radius 0 copies.
Plane BoxBlur(const Plane& plane, int radius);
/// About a Gaussian of a standard deviation in pixels: three box blurs. Below 0.3 pixels it copies.
Plane Blur(const Plane& plane, float deviation);

/// Mean of each block of factor x factor pixels. @throws Error if the sizes are no multiples of the factor.
Plane AverageDown(const Plane& plane, int factor);

/// Bilinear at (x, y) in pixels, centres at + 0.5; the border continues outside.
float SampleAt(const Plane& plane, float x, float y);

}  // namespace daumier::render
