#pragma once
#include <algorithm>
#include <cmath>

namespace daumier::render {

/// A halftone screen of round dots: what a tone covers at a point.
class DotScreen {
 public:
  /// `spacing` of dots, pixels; `angle` of their rows, radians.
  DotScreen(float spacing, float angle)
      : cos_(std::cos(angle) / spacing), sin_(std::sin(angle) / spacing), softness_(std::min(0.9f, 1.4f / spacing)) {}

  /// Coverage in 0..1 at (x, y), pixels: none for a tone of 0, all for 1, and on average about the tone. The mean of two
  /// waves, from -1 to 1, is compared with 1 - 2 tone; edges are about a pixel soft.
  float Coverage(float x, float y, float tone) const {
    if (tone <= 0.01f) return 0;
    if (tone >= 0.99f) return 1;
    const float level = 0.5f * (Wave(cos_ * x + sin_ * y) + Wave(cos_ * y - sin_ * x));
    return std::clamp((level - (1 - 2 * tone)) / softness_ + 0.5f, 0.0f, 1.0f);
  }

 private:
  /// About the cosine of 2 pi place.
  static float Wave(float place) {
    const float t = place - std::floor(place);
    const float triangle = std::abs(4 * t - 2) - 1;
    return triangle * (1.5f - 0.5f * triangle * triangle);
  }

  float cos_, sin_, softness_;
};

}  // namespace daumier::render
