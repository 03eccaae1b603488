#include "render/styles/light_layers.h"
#include "render/styles/picture_lines.h"

#include <algorithm>
#include <cmath>

namespace daumier::render {
namespace {

constexpr float kValleyBlur = 1.2f;       ///< Units.
constexpr float kFaintValley = 0.012f;    ///< Second derivative of n . v a unit squared at which a line begins.
constexpr float kDeepValley = 0.075f;     ///< And at which it is as strong as it gets.
constexpr float kValleyStrength = 0.75f;  ///< Of the strongest.

bool HasValleys(const PictureLayers& layers, size_t pixel) {
  if (layers.coverage.values[pixel] < 0.99f) return false;
  switch (static_cast<PicturePart>(layers.parts[pixel])) {
    case PicturePart::kSkin:
    case PicturePart::kHair:
    case PicturePart::kHat:
      return layers.classes[pixel] != static_cast<uint8_t>(PictureClass::kMouth);
    default:
      return false;
  }
}

}  // namespace

std::vector<LinePoint> ValleyLines(const PictureLayers& layers) {
  const int height = layers.height, width = layers.width;
  // Beyond the covered the plane continues as 1, so that the silhouette is no valley.
  Plane facing(height, width, 1);
  for (size_t i = 0; i < layers.size(); ++i) {
    if (layers.coverage.values[i] > 0) facing.values[i] = std::clamp(layers.normal[2].values[i], 0.0f, 1.0f);
  }
  facing = Blur(facing, kValleyBlur * layers.scale);
  const float unit = layers.scale * layers.scale;
  std::vector<LinePoint> points;
  for (int row = 2; row + 2 < height; ++row) {
    const float *above = facing.row(row - 1), *here = facing.row(row), *below = facing.row(row + 1);
    for (int column = 2; column + 2 < width; ++column) {
      const float xx = here[column - 1] + here[column + 1] - 2 * here[column];
      const float yy = above[column] + below[column] - 2 * here[column];
      if (xx + yy <= 0 || !HasValleys(layers, size_t(row) * width + column)) continue;
      const float xy = 0.25f * (above[column - 1] + below[column + 1] - above[column + 1] - below[column - 1]);
      const float half = 0.5f * (xx - yy);
      const float largest = 0.5f * (xx + yy) + std::sqrt(half * half + xy * xy);
      if (largest * unit < kFaintValley) continue;
      float across_x = largest - yy, across_y = xy;
      if (std::abs(across_x) + std::abs(across_y) < 1e-6f) across_x = xx >= yy ? 1.0f : 0.0f, across_y = 1 - across_x;
      const float length = std::hypot(across_x, across_y);
      across_x /= length;
      across_y /= length;
      const float slope =
          0.5f * ((here[column + 1] - here[column - 1]) * across_x + (below[column] - above[column]) * across_y);
      const float offset = -slope / largest;
      if (std::abs(offset) > 0.6f) continue;
      const float strength = (largest * unit - kFaintValley) / (kDeepValley - kFaintValley);
      points.push_back({static_cast<float>(column) + 0.5f + offset * across_x,
                        static_cast<float>(row) + 0.5f + offset * across_y,
                        kValleyStrength * std::min(strength, 1.0f)});
    }
  }
  return points;
}

}  // namespace daumier::render
