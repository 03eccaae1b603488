#pragma once
#include "render/styles/colour_planes.h"
#include "render/styles/picture_buffers.h"

#include <cmath>
#include <numeric>

namespace daumier::testing {

/// A head of simple forms: a ball of skin with brows, lips, ears of the same, two eyes with irises and a cap of hair,
/// lit from the upper left. size x size pixels of the picture.
inline render::PictureBuffers BallHead(int size = 64, int supersampling = 2) {
  using namespace render;
  PictureBuffers buffers = EmptyPictureBuffers(size * supersampling, size * supersampling, supersampling);
  const float pixels = static_cast<float>(size * supersampling);
  buffers.pixels_per_cm = pixels / 24;
  const auto paint = [&](size_t pixel, PictureClass picture_class, PicturePart part, float red, float green,
                         float blue) {
    buffers.classes[pixel] = static_cast<uint8_t>(picture_class);
    buffers.parts[pixel] = static_cast<uint8_t>(part);
    buffers.albedo[3 * pixel] = red;
    buffers.albedo[3 * pixel + 1] = green;
    buffers.albedo[3 * pixel + 2] = blue;
  };
  for (int row = 0; row < buffers.height; ++row) {
    for (int column = 0; column < buffers.width; ++column) {
      // A ball of 9 cm about the middle.
      const float x = (static_cast<float>(column) + 0.5f) / pixels * 24 - 12,
                  y = 12 - (static_cast<float>(row) + 0.5f) / pixels * 24;
      const float rest = 81 - x * x - y * y;
      if (rest <= 0) continue;
      const float z = std::sqrt(rest);
      const size_t pixel = size_t(row) * buffers.width + column;
      buffers.normal[3 * pixel] = x / 9;
      buffers.normal[3 * pixel + 1] = y / 9;
      buffers.normal[3 * pixel + 2] = z / 9;
      buffers.shade[pixel] = 0.65f + 0.3f * (-0.5f * x + 0.6f * y + 0.62f * z) / 9;
      buffers.depth[pixel] = 100 - z;
      paint(pixel, PictureClass::kSkin, PicturePart::kSkin, 0.8f + 0.004f * x, 0.6f, 0.5f);
      const float eye = std::hypot(std::abs(x) - 3.2f, y - 1);
      if (y > 5) {
        paint(pixel, PictureClass::kHair, PicturePart::kHair, 0.25f, 0.15f, 0.1f);
      } else if (std::abs(y - 3.2f) < 0.5f && std::abs(std::abs(x) - 3.2f) < 2) {
        paint(pixel, PictureClass::kBrows, PicturePart::kSkin, 0.3f, 0.2f, 0.15f);
      } else if (eye < 0.8f) {
        paint(pixel, PictureClass::kEyes, PicturePart::kEyeball, 0.2f, 0.35f, 0.5f);
      } else if (eye < 1.5f) {
        paint(pixel, PictureClass::kEyes, PicturePart::kEyeball, 0.95f, 0.95f, 0.95f);
      } else if (std::abs(y + 4) < 0.9f && std::abs(x) < 2.5f) {
        paint(pixel, PictureClass::kLips, PicturePart::kSkin, 0.75f, 0.35f, 0.35f);
      }
    }
  }
  return buffers;
}

/// A strip of skin whose shade rises from 0 to 1, 16 rows.
inline render::PictureBuffers ShadeRamp(int width) {
  render::PictureBuffers buffers = render::EmptyPictureBuffers(16, width);
  for (size_t i = 0; i < buffers.size(); ++i) {
    buffers.depth[i] = 100;
    buffers.classes[i] = static_cast<uint8_t>(PictureClass::kSkin);
    buffers.shade[i] = static_cast<float>(i % width) / static_cast<float>(width - 1);
    for (int channel = 0; channel < 3; ++channel) buffers.albedo[3 * i + channel] = 0.5f;
  }
  return buffers;
}

inline double MeanOfPlane(const render::Plane& plane) {
  return std::accumulate(plane.values.begin(), plane.values.end(), 0.0) / static_cast<double>(plane.values.size());
}

}  // namespace daumier::testing
