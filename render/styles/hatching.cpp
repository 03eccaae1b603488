#include "render/styles/hatching.h"

#include "render/styles/plane_noise.h"

#include <algorithm>
#include <cmath>

namespace daumier::render {
namespace {

/// From which darkness a layer's lines are drawn, from where they are widest, and how they are turned.
struct HatchLayer {
  float from, full, turn;
};
constexpr std::array<HatchLayer, 3> kHatchLayers = {{{0.08f, 0.75f, 0}, {0.40f, 0.95f, 1.05f}, {0.65f, 1.0f, -0.75f}}};

}  // namespace

Plane Hatch(const Plane& darkness, const HatchStyle& style, Rng& rng) {
  const int height = darkness.height, width = darkness.width;
  Plane ink(height, width);
  const float spacing = std::max(style.spacing, 1.5f), lines_a_pixel = 1 / spacing;
  // A transition of a pixel in the triangle wave |2 t - 1|, which has the slope 2 / spacing.
  const float edge = lines_a_pixel * (1 + 2 * style.softness);
  for (const HatchLayer& layer : kHatchLayers) {
    const float angle = style.angle + layer.turn;
    const float across_x = -std::sin(angle) * lines_a_pixel, across_y = std::cos(angle) * lines_a_pixel;
    const float cell = 5 * spacing;
    const Plane wave = SmoothNoise(height, width, cell, cell, rng);
    const Plane pressure = SmoothNoise(height, width, 2.5f * spacing, 2.5f * spacing, rng);
    const float phase = static_cast<float>(rng.Uniform(64, 128));
    for (int row = 0; row < height; ++row) {
      const float* dark = darkness.row(row);
      const float *waves = wave.row(row), *pressures = pressure.row(row);
      float* target = ink.row(row);
      const float start = phase + across_y * static_cast<float>(row) + 1000;
      for (int column = 0; column < width; ++column) {
        const float value = dark[column] + 0.05f * pressures[column];
        if (value <= layer.from) continue;
        const float amount = std::min(1.0f, (value - layer.from) / (layer.full - layer.from));
        const float place = start + across_x * static_cast<float>(column) + style.wobble * waves[column];
        const float t = place - static_cast<float>(static_cast<int>(place));
        const float from_middle = std::abs(2 * t - 1);
        const float half = 0.12f + 0.62f * amount;
        float coverage = std::clamp((half - from_middle) / (2 * edge) + 0.5f, 0.0f, 1.0f);
        // A line begins lightly.
        coverage *= std::min(1.0f, 4 * amount + 0.2f);
        target[column] = std::max(target[column], coverage);
      }
    }
  }
  return ink;
}

}  // namespace daumier::render
