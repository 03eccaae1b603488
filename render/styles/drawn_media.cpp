#include "render/styles/drawn_media.h"

#include "render/styles/hatching.h"
#include "render/styles/light_layers.h"
#include "render/styles/plane_noise.h"
#include "render/styles/surface_colours.h"

#include <algorithm>
#include <cmath>

namespace daumier::render {
namespace {

float Ramp(float from, float to, float value) {
  return std::clamp((value - from) / (to - from), 0.0f, 1.0f);
}

/// The brightness at which paper is left white: of the lightest skin, as far as that is dark, so that dark faces are
/// drawn with light and shade, too.
float WhiteOf(const Plane& luma, const PictureLayers& layers) {
  std::vector<float> skin;
  for (size_t i = 0; i < layers.size(); i += 2) {
    if (layers.coverage.values[i] > 0.99f && layers.classes[i] == static_cast<uint8_t>(PictureClass::kSkin)) {
      skin.push_back(luma.values[i]);
    }
  }
  if (skin.size() < 16) return 0.95f;
  const auto place = skin.begin() + static_cast<std::ptrdiff_t>(0.9 * static_cast<double>(skin.size()));
  std::nth_element(skin.begin(), place, skin.end());
  return std::clamp(0.3f + 0.72f * *place, 0.45f, 0.95f);
}

Plane RelativeDarkness(const MediumInput& input, const PictureLayers& layers) {
  Plane darkness = Luma(input.colours);
  const float scale = 1 / WhiteOf(darkness, layers);
  for (float& value : darkness.values) value = std::clamp(1 - value * scale, 0.0f, 1.0f);
  return darkness;
}

}  // namespace

ColourPlanes PencilDrawing(const MediumInput& input, const PictureLayers& layers, const StyleChoice& choice, Rng& rng) {
  const Plane darkness = RelativeDarkness(input, layers);
  const HatchStyle style{choice.screen * layers.scale, choice.angle, 1, 0.3f};
  const Plane hatches = Hatch(darkness, style, rng);
  const Plane grain = PaperGrain(layers.height, layers.width, rng);
  ColourPlanes drawing = input.colours;
  for (size_t i = 0; i < layers.size(); ++i) {
    const float dark = darkness.values[i];
    // Smudged tone under the hatches; graphite keeps to the tops of the paper's tooth unless it is pressed hard.
    const float tone = 0.45f * dark + hatches.values[i] * (0.22f + 0.55f * dark);
    const float line = 0.85f * input.ink.values[i];
    float graphite = std::max(tone, line);
    graphite *= std::clamp(0.55f + 1.1f * (graphite + 0.9f * (grain.values[i] - 0.55f)), 0.0f, 1.15f);
    graphite = std::min(graphite, 0.92f);
    for (int channel = 0; channel < 3; ++channel) {
      const float paper = choice.paper[channel] * (0.98f + 0.04f * grain.values[i]);
      float& value = drawing[channel].values[i];
      const float grey = paper + graphite * (0.16f - paper);
      // Coloured pencils: as much pigment as the colour is away from white, in strokes as well.
      const float pigment =
          std::clamp((0.62f + 0.3f * hatches.values[i]) * (0.72f + 0.5f * grain.values[i]), 0.0f, 1.0f);
      const float deep = std::pow(std::max(value, 0.0f), 0.9f) * paper;
      const float coloured =
          (paper + pigment * (deep - paper)) * (1 - 0.75f * std::max(line, 0.45f * (graphite - 0.3f)));
      value = grey + choice.coloured * (coloured - grey);
    }
  }
  return drawing;
}

ColourPlanes InkDrawing(const MediumInput& input, const PictureLayers& layers, const StyleChoice& choice, Rng& rng) {
  Plane darkness = RelativeDarkness(input, layers);
  const Plane albedo = Luma(layers.albedo);
  Plane shade = SmoothShade(layers, 2);
  const ShadeRange range = RangeOfShade(layers);
  const float span = std::max(range.lightest - range.darkest, 0.25f * range.lightest) + 1e-3f;
  Plane black(layers.height, layers.width), tone(layers.height, layers.width);
  for (size_t i = 0; i < layers.size(); ++i) {
    if (layers.coverage.values[i] == 0) {
      tone.values[i] = 0.55f * std::max(0.0f, darkness.values[i] - 0.15f);
      continue;
    }
    const float lit = Ramp(0, 1, (shade.values[i] - range.darkest) / span);
    const bool is_skin = layers.parts[i] == static_cast<uint8_t>(PicturePart::kSkin) &&
                         layers.classes[i] != static_cast<uint8_t>(PictureClass::kBrows);
    const bool is_lip = layers.classes[i] == static_cast<uint8_t>(PictureClass::kLips);
    const bool is_eye = layers.parts[i] == static_cast<uint8_t>(PicturePart::kEyeball);
    // Black hair and cloth with lights left out; skin is never black.
    if (!is_skin)
      black.values[i] = Ramp(0.40f, 0.24f, albedo.values[i] + (is_eye ? 0.02f : 0.14f * Ramp(0.75f, 1, lit)));
    const float own = is_skin ? (is_lip ? 0.25f : 0.10f) : 0.75f * Ramp(0.85f, 0.25f, albedo.values[i]);
    tone.values[i] =
        is_eye ? 0.0f : std::clamp(own + 0.62f * Ramp(0.45f, 0.0f, lit) - (is_skin ? 0.08f : 0.0f), 0.0f, 0.9f);
  }
  black = Blur(black, 0.5f * layers.scale);
  const HatchStyle style{choice.screen * layers.scale, choice.angle, 0, 0.22f};
  const Plane hatches = Hatch(tone, style, rng);
  ColourPlanes drawing = input.colours;
  for (size_t i = 0; i < layers.size(); ++i) {
    const float covered = std::max({input.ink.values[i], hatches.values[i], Ramp(0.3f, 0.7f, black.values[i])});
    for (int channel = 0; channel < 3; ++channel) {
      float& value = drawing[channel].values[i];
      const float wash = choice.paper[channel] * (0.25f + 0.75f * std::clamp(value, 0.0f, 1.0f));
      const float ground = choice.paper[channel] + choice.coloured * (wash - choice.paper[channel]);
      value = ground + covered * (choice.line_colour[channel] - ground);
    }
  }
  return drawing;
}

ColourPlanes Watercolour(const MediumInput& input, const PictureLayers& layers, const StyleChoice& choice, Rng& rng) {
  const int height = layers.height, width = layers.width;
  const float scale = layers.scale;
  const Plane across = FractalNoise(height, width, 16 * scale, 2, rng),
              down = FractalNoise(height, width, 16 * scale, 2, rng);
  ColourPlanes washes = input.colours;
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const size_t i = size_t(row) * width + column;
      const float x = static_cast<float>(column) + 0.5f + 0.9f * scale * across.values[i];
      const float y = static_cast<float>(row) + 0.5f + 0.9f * scale * down.values[i];
      for (int channel = 0; channel < 3; ++channel) {
        washes[channel].values[i] = SampleAt(input.colours[channel], x, y);
      }
    }
  }
  for (Plane& plane : washes) plane = Blur(plane, 0.6f * scale);
  const Plane luma = Luma(washes), around = Blur(luma, 2.5f * scale);
  const Plane pools = FractalNoise(height, width, 38 * scale, 3, rng), grain = PaperGrain(height, width, rng);
  for (size_t i = 0; i < layers.size(); ++i) {
    // Pigment is carried to the border of a wash, on its own side: where it is darker than its surroundings.
    const float border = std::clamp((around.values[i] - luma.values[i]) * 9, 0.0f, 1.0f);
    const float density = 1 + 0.75f * border + 0.42f * pools.values[i] + 0.55f * (grain.values[i] - 0.5f);
    for (int channel = 0; channel < 3; ++channel) {
      float value = std::clamp(washes[channel].values[i], 0.0f, 1.0f);
      value = 0.06f + 0.94f * value;
      value -= (value - value * value) * (density - 1);
      value *= choice.paper[channel] * (0.985f + 0.03f * grain.values[i]);
      const float line = 0.8f * input.ink.values[i] * std::min(1.0f, 0.7f + 0.6f * grain.values[i]);
      washes[channel].values[i] = value + line * (choice.line_colour[channel] - value);
    }
  }
  return washes;
}

}  // namespace daumier::render
