#include "render/styles/picture_lines.h"

#include "core/error.h"
#include "render/styles/ink_stamp.h"
#include "render/styles/light_layers.h"
#include "render/styles/plane_noise.h"

#include <algorithm>
#include <cmath>

namespace daumier::render {
namespace {

/// What a hand with a pen does: width by strength, shade and pressure; small deviations.
class PenHand {
 public:
  PenHand(const PictureLayers& layers, const StyleChoice& choice, Rng& rng)
      : choice_(choice), half_width_(0.5f * choice.line_width * layers.scale), scale_(layers.scale) {
    const float cell = 14 * layers.scale;
    pressure_ = SmoothNoise(layers.height, layers.width, cell, cell, rng);
    if (choice.line_wobble > 0) {
      across_ = SmoothNoise(layers.height, layers.width, cell, cell, rng);
      down_ = SmoothNoise(layers.height, layers.width, cell, cell, rng);
    }
  }

  void Stamp(Plane& ink, const LinePoint& point) const {
    const size_t pixel = size_t(std::clamp(static_cast<int>(point.y), 0, ink.height - 1)) * ink.width +
                         std::clamp(static_cast<int>(point.x), 0, ink.width - 1);
    const float kept = 1 - choice_.line_variation + choice_.line_variation * point.strength;
    const float pressure = 1 + 0.5f * choice_.line_variation * pressure_.values[pixel];
    // Without variation faint creases still are no lines.
    const float faint = point.strength < 0.12f ? point.strength / 0.12f : 1.0f;
    const float half = (half_width_ + 0.5f) * kept * pressure * faint - 0.5f;
    float x = point.x, y = point.y;
    if (choice_.line_wobble > 0) {
      x += choice_.line_wobble * scale_ * across_.values[pixel];
      y += choice_.line_wobble * scale_ * down_.values[pixel];
    }
    StampInk(ink, x, y, half);
  }

 private:
  const StyleChoice& choice_;
  float half_width_, scale_;
  Plane pressure_, across_, down_;
};

/// A given line with the swell of a pen stroke: thin at its ends.
void StampStroke(Plane& ink, const Stroke& stroke, float scale, const PenHand& hand) {
  for (const auto& point : stroke.points) {
    DAUMIER_CHECK(std::isfinite(point[0]) && std::isfinite(point[1]), "a line has a point that is not finite");
  }
  std::vector<float> lengths(stroke.points.size(), 0.0f);
  for (size_t i = 1; i < stroke.points.size(); ++i) {
    lengths[i] = lengths[i - 1] + scale * std::hypot(stroke.points[i][0] - stroke.points[i - 1][0],
                                                     stroke.points[i][1] - stroke.points[i - 1][1]);
  }
  if (lengths.empty() || lengths.back() <= 0) return;
  const float taper = std::min(12.0f, 0.4f * lengths.back());
  constexpr float kStep = 0.5f;
  size_t segment = 1;
  for (float at = 0; at <= lengths.back(); at += kStep) {
    while (segment + 1 < lengths.size() && lengths[segment] < at) ++segment;
    const float span = lengths[segment] - lengths[segment - 1];
    const float t = span > 0 ? (at - lengths[segment - 1]) / span : 0.0f;
    const auto &from = stroke.points[segment - 1], &to = stroke.points[segment];
    const float to_end = std::min(at, lengths.back() - at);
    const float swell = std::min(1.0f, 0.35f + 0.65f * to_end / taper);
    hand.Stamp(ink,
               {scale * (from[0] + t * (to[0] - from[0])), scale * (from[1] + t * (to[1] - from[1])), 0.85f * swell});
  }
}

}  // namespace

Plane DrawPictureLines(const PictureBuffers& buffers, const PictureLayers& layers, const StyleChoice& choice,
                       Rng& rng) {
  Plane ink(layers.height, layers.width);
  if (choice.lines == LineSource::kNone || choice.line_width <= 0) return ink;
  const PenHand hand(layers, choice, rng);
  for (const LinePoint& point : BorderLines(buffers)) hand.Stamp(ink, point);
  if (choice.lines == LineSource::kStrokes && !buffers.lines.empty()) {
    const float scale = 1.0f / static_cast<float>(buffers.supersampling);
    for (const Stroke& stroke : buffers.lines) StampStroke(ink, stroke, scale, hand);
  } else {
    for (const LinePoint& point : ValleyLines(layers)) hand.Stamp(ink, point);
  }
  return ink;
}

void InkOver(ColourPlanes& colours, const Plane& ink, const StyleChoice& choice) {
  for (int channel = 0; channel < 3; ++channel) {
    for (size_t i = 0; i < ink.values.size(); ++i) {
      if (ink.values[i] <= 0) continue;
      float& value = colours[channel].values[i];
      const float own = 0.35f * value * value + 0.05f * value;
      const float colour = choice.line_colour[channel] + choice.line_tint * (own - choice.line_colour[channel]);
      value += ink.values[i] * (colour - value);
    }
  }
}

}  // namespace daumier::render
