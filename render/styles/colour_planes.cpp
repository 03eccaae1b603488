#include "render/styles/colour_planes.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>

namespace daumier::render {
namespace {

/// Running mean along each row, from -> to.
void BlurRows(const Plane& from, Plane& to, int radius) {
  const int width = from.width;
  for (int row = 0; row < from.height; ++row) {
    const float* source = from.row(row);
    float* target = to.row(row);
    float sum = 0;
    int count = 0;
    for (int column = 0; column < std::min(radius, width); ++column, ++count) sum += source[column];
    for (int column = 0; column < width; ++column) {
      if (column + radius < width) sum += source[column + radius], ++count;
      if (column - radius > 0) sum -= source[column - radius - 1], --count;
      target[column] = sum / static_cast<float>(count);
    }
  }
}

/// Running mean along each column, a row at a time.
void BlurColumns(const Plane& from, Plane& to, int radius) {
  const int height = from.height, width = from.width;
  std::vector<float> sums(width, 0.0f);
  int count = 0;
  for (int row = 0; row < std::min(radius, height); ++row, ++count) {
    const float* source = from.row(row);
    for (int column = 0; column < width; ++column) sums[column] += source[column];
  }
  for (int row = 0; row < height; ++row) {
    if (row + radius < height) {
      const float* source = from.row(row + radius);
      for (int column = 0; column < width; ++column) sums[column] += source[column];
      ++count;
    }
    if (row - radius > 0) {
      const float* source = from.row(row - radius - 1);
      for (int column = 0; column < width; ++column) sums[column] -= source[column];
      --count;
    }
    const float share = 1.0f / static_cast<float>(count);
    float* target = to.row(row);
    for (int column = 0; column < width; ++column) target[column] = sums[column] * share;
  }
}

}  // namespace

ColourPlanes MakeColourPlanes(int height, int width, const std::array<float, 3>& colour) {
  return {Plane(height, width, colour[0]), Plane(height, width, colour[1]), Plane(height, width, colour[2])};
}

Plane Luma(const ColourPlanes& colours) {
  Plane luma(colours[0].height, colours[0].width);
  const float *red = colours[0].values.data(), *green = colours[1].values.data(), *blue = colours[2].values.data();
  for (size_t i = 0; i < luma.values.size(); ++i) {
    luma.values[i] = 0.299f * red[i] + 0.587f * green[i] + 0.114f * blue[i];
  }
  return luma;
}

Image ToImage(const ColourPlanes& colours) {
  Image image(colours[0].height, colours[0].width, 3);
  const size_t size = colours[0].values.size();
  for (int channel = 0; channel < 3; ++channel) {
    const float* values = colours[channel].values.data();
    for (size_t i = 0; i < size; ++i) {
      image.pixels[3 * i + channel] = static_cast<uint8_t>(std::clamp(values[i], 0.0f, 1.0f) * 255.0f + 0.5f);
    }
  }
  return image;
}

ColourPlanes ToPlanes(const Image& image) {
  ColourPlanes colours = MakeColourPlanes(image.height, image.width, {0, 0, 0});
  const size_t size = colours[0].values.size();
  for (int channel = 0; channel < 3; ++channel) {
    float* values = colours[channel].values.data();
    const int from = image.channels == 3 ? channel : 0;
    for (size_t i = 0; i < size; ++i) {
      values[i] = static_cast<float>(image.pixels[i * image.channels + from]) * (1.0f / 255.0f);
    }
  }
  return colours;
}

Plane BoxBlur(const Plane& plane, int radius) {
  if (radius <= 0) return plane;
  Plane rows(plane.height, plane.width), blurred(plane.height, plane.width);
  BlurRows(plane, rows, radius);
  BlurColumns(rows, blurred, radius);
  return blurred;
}

Plane Blur(const Plane& plane, float deviation) {
  if (deviation < 0.3f) return plane;
  // A box of radius r has the variance ((2 r + 1)^2 - 1) / 12; radii of the three differ by at most 1.
  const float wanted = 12.0f * deviation * deviation;
  int radius = 0;
  while (3.0f * static_cast<float>((2 * radius + 3) * (2 * radius + 3) - 1) <= wanted) ++radius;
  const auto variance = [](int r) { return static_cast<float>((2 * r + 1) * (2 * r + 1) - 1); };
  const float missing = wanted - 3 * variance(radius);
  const int num_larger = std::clamp(static_cast<int>(std::lround(missing / (variance(radius + 1) - variance(radius)))),
                                    radius == 0 ? 1 : 0, 3);
  Plane current = plane, other(plane.height, plane.width);
  for (int pass = 0; pass < 3; ++pass) {
    const int r = radius + (pass < num_larger ? 1 : 0);
    if (r == 0) continue;
    BlurRows(current, other, r);
    BlurColumns(other, current, r);
  }
  return current;
}

Plane AverageDown(const Plane& plane, int factor) {
  DAUMIER_CHECK(factor >= 1 && plane.height % factor == 0 && plane.width % factor == 0,
                "the plane is {} x {}, expected multiples of {}", plane.height, plane.width, factor);
  if (factor == 1) return plane;
  Plane small(plane.height / factor, plane.width / factor);
  const float share = 1.0f / static_cast<float>(factor * factor);
  for (int row = 0; row < plane.height; ++row) {
    const float* source = plane.row(row);
    float* target = small.row(row / factor);
    for (int column = 0; column < small.width; ++column) {
      for (int i = 0; i < factor; ++i) target[column] += source[column * factor + i];
    }
  }
  for (float& value : small.values) value *= share;
  return small;
}

float SampleAt(const Plane& plane, float x, float y) {
  x = std::clamp(x - 0.5f, 0.0f, static_cast<float>(plane.width - 1));
  y = std::clamp(y - 0.5f, 0.0f, static_cast<float>(plane.height - 1));
  const int left = static_cast<int>(x), top = static_cast<int>(y);
  const int right = std::min(left + 1, plane.width - 1), bottom = std::min(top + 1, plane.height - 1);
  const float u = x - static_cast<float>(left), v = y - static_cast<float>(top);
  const float *above = plane.row(top), *below = plane.row(bottom);
  return (above[left] * (1 - u) + above[right] * u) * (1 - v) + (below[left] * (1 - u) + below[right] * u) * v;
}

}  // namespace daumier::render
