#include "render/styles/filled_shapes.h"

#include <algorithm>
#include <cmath>

namespace daumier::render {
namespace {

/// Paints pixels within `reach` of (x, y) by coverage(along, across) in the shape's own axes.
template <class Coverage>
void PaintTurned(ColourPlanes& colours, float x, float y, float half_x, float half_y, float angle,
                 const ShapePaint& paint, Coverage&& coverage) {
  const int height = colours[0].height, width = colours[0].width;
  const float c = std::cos(angle), s = std::sin(angle);
  const float reach_x = std::abs(c) * half_x + std::abs(s) * half_y + 1,
              reach_y = std::abs(s) * half_x + std::abs(c) * half_y + 1;
  const auto limited = [](float value, int most) {
    return static_cast<int>(std::clamp(value, 0.0f, static_cast<float>(most)));
  };
  const int top = limited(y - reach_y, height), bottom = limited(y + reach_y + 1, height),
            left = limited(x - reach_x, width), right = limited(x + reach_x + 1, width);
  for (int row = top; row < bottom; ++row) {
    const float down = static_cast<float>(row) + 0.5f - y;
    for (int column = left; column < right; ++column) {
      const float across = static_cast<float>(column) + 0.5f - x;
      const float share = paint.alpha * std::clamp(coverage(c * across + s * down, c * down - s * across), 0.0f, 1.0f);
      if (share <= 0) continue;
      for (int channel = 0; channel < 3; ++channel) {
        float& value = colours[channel].at(row, column);
        value += share * (paint.colour[channel] - value);
      }
    }
  }
}

}  // namespace

void FillEllipse(ColourPlanes& colours, float x, float y, float half_x, float half_y, float angle,
                 const ShapePaint& paint) {
  const float inverse_x = 1 / std::max(half_x, 0.1f), inverse_y = 1 / std::max(half_y, 0.1f);
  const float size = std::min(half_x, half_y);
  PaintTurned(colours, x, y, half_x, half_y, angle, paint, [&](float along, float across) {
    const float u = along * inverse_x, v = across * inverse_y;
    return (1 - std::sqrt(u * u + v * v)) * size + 0.5f;
  });
}

void FillBox(ColourPlanes& colours, float x, float y, float half_x, float half_y, float angle, float corner,
             const ShapePaint& paint) {
  corner = std::min({corner, half_x, half_y});
  PaintTurned(colours, x, y, half_x, half_y, angle, paint, [&](float along, float across) {
    const float u = std::abs(along) - half_x + corner, v = std::abs(across) - half_y + corner;
    const float outside = u > 0 && v > 0 ? std::sqrt(u * u + v * v) : std::max(u, v);
    return corner - outside + 0.5f;
  });
}

void FillBelow(ColourPlanes& colours, const std::vector<float>& top, const ShapePaint& paint) {
  for (int row = 0; row < colours[0].height; ++row) {
    for (int column = 0; column < colours[0].width; ++column) {
      const float share = paint.alpha * std::clamp(static_cast<float>(row) + 1 - top[column], 0.0f, 1.0f);
      if (share <= 0) continue;
      for (int channel = 0; channel < 3; ++channel) {
        float& value = colours[channel].at(row, column);
        value += share * (paint.colour[channel] - value);
      }
    }
  }
}

}  // namespace daumier::render
