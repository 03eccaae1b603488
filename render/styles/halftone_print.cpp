#include "render/styles/dot_screen.h"
#include "render/styles/drawn_media.h"
#include "render/styles/light_layers.h"
#include "render/styles/picture_lines.h"

#include <algorithm>
#include <cmath>

namespace daumier::render {
namespace {

Plane ShadowTone(const PictureLayers& layers, const StyleChoice& choice) {
  Plane tone = SmoothShade(layers, 1.5f);
  const ShadeRange range = RangeOfShade(layers);
  const float span = std::max(range.lightest - range.darkest, 0.25f * range.lightest) + 1e-3f;
  const Plane shadow = choice.shadows > 0 ? CastShadows(layers, MainLight(layers)) : Plane(layers.height, layers.width);
  for (size_t i = 0; i < tone.values.size(); ++i) {
    if (layers.coverage.values[i] == 0 || layers.parts[i] == static_cast<uint8_t>(PicturePart::kEyeball) ||
        layers.parts[i] == static_cast<uint8_t>(PicturePart::kHighlight)) {
      tone.values[i] = 0;
      continue;
    }
    const float lit = (tone.values[i] - range.darkest) / span;
    tone.values[i] = std::clamp(std::max(0.75f - 1.15f * lit, 0.6f * shadow.values[i]), 0.0f, 0.7f);
  }
  return tone;
}

}  // namespace

ColourPlanes HalftonePrint(const MediumInput& input, const PictureLayers& layers, const StyleChoice& choice) {
  ColourPlanes print = input.colours;
  const float spacing = std::max(choice.screen * layers.scale, 2.0f);
  const auto over_pixels = [&](auto&& change) {
    for (int row = 0; row < layers.height; ++row) {
      for (int column = 0; column < layers.width; ++column) {
        change(size_t(row) * layers.width + column, static_cast<float>(column) + 0.5f, static_cast<float>(row) + 0.5f);
      }
    }
  };
  switch (choice.screens) {
    case ScreenKind::kBlack: {
      const Plane luma = Luma(input.colours);
      const DotScreen screen(spacing, choice.angle);
      over_pixels([&](size_t i, float x, float y) {
        // The darkest tones are solid black, the lightest bare paper.
        const float tone = std::clamp(1.12f - 1.18f * std::sqrt(std::max(luma.values[i], 0.0f)) * 1.05f, 0.0f, 1.0f);
        const float dot = screen.Coverage(x, y, tone);
        for (int channel = 0; channel < 3; ++channel) {
          print[channel].values[i] =
              choice.paper[channel] + dot * (choice.line_colour[channel] - choice.paper[channel]);
        }
      });
      break;
    }
    case ScreenKind::kShadows: {
      const Plane tone = ShadowTone(layers, choice);
      const DotScreen screen(spacing, choice.angle);
      over_pixels([&](size_t i, float x, float y) {
        const float dot = screen.Coverage(x, y, tone.values[i]) * layers.coverage.values[i];
        if (dot <= 0) return;
        for (int channel = 0; channel < 3; ++channel) {
          print[channel].values[i] *= 1 - dot * (1 - (1 - choice.band_depth) * choice.shadow_hue[channel]);
        }
      });
      break;
    }
    case ScreenKind::kProcess: {
      const std::array<DotScreen, 4> screens = {
          DotScreen(spacing, choice.angle + 0.26f), DotScreen(spacing, choice.angle + 1.31f),
          DotScreen(spacing, choice.angle), DotScreen(spacing, choice.angle + 0.79f)};
      // Light that each printing ink leaves.
      constexpr std::array<std::array<float, 3>, 4> kInks = {
          {{0.10f, 0.66f, 0.86f}, {0.90f, 0.16f, 0.50f}, {0.99f, 0.90f, 0.12f}, {0.10f, 0.10f, 0.12f}}};
      over_pixels([&](size_t i, float x, float y) {
        std::array<float, 3> absent{};
        for (int channel = 0; channel < 3; ++channel) {
          absent[channel] = 1 - std::clamp(print[channel].values[i], 0.0f, 1.0f);
        }
        const float black = 0.8f * std::min({absent[0], absent[1], absent[2]});
        std::array<float, 3> left = choice.paper;
        for (int ink = 0; ink < 4; ++ink) {
          const float tone = ink == 3 ? black : (absent[ink] - black) / (1 - black + 1e-3f);
          const float dot = screens[ink].Coverage(x, y, tone);
          for (int channel = 0; channel < 3; ++channel) left[channel] *= 1 - dot * (1 - kInks[ink][channel]);
        }
        for (int channel = 0; channel < 3; ++channel) print[channel].values[i] = left[channel];
      });
      break;
    }
  }
  InkOver(print, input.ink, choice);
  return print;
}

}  // namespace daumier::render
