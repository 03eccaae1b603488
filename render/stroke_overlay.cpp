#include "render/stroke_overlay.h"

#include "render/draw.h"

#include <array>

namespace daumier::render {

Image DrawnWithCurves(const std::vector<Stroke>& drawn, const std::vector<Stroke>& curves, int size) {
  Image picture = ToRgb(RasteriseStrokes(drawn, size));
  const Image above = RasteriseStrokes(curves, size, {.width = 1.0});
  constexpr std::array<int, 3> kRed = {220, 50, 47};
  for (size_t i = 0; i < above.pixels.size(); ++i) {
    const int ink = 255 - above.pixels[i];
    for (size_t channel = 0; channel < 3; ++channel) {
      uint8_t& value = picture.pixels[3 * i + channel];
      value = static_cast<uint8_t>((value * (255 - ink) + kRed[channel] * ink) / 255);
    }
  }
  return picture;
}

}  // namespace daumier::render
