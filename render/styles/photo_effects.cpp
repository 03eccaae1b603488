#include "render/styles/photo_effects.h"

#include "core/error.h"
#include "render/styles/colour_planes.h"
#include "render/styles/jpeg_loss.h"
#include "render/styles/plane_noise.h"

#include <algorithm>
#include <cmath>

namespace daumier::render {
namespace {

/// Averaged over cells of `factor` pixels, and enlarged again by bilinear interpolation.
Plane FromFewerPixels(const Plane& plane, float factor) {
  const int height = std::max(1, static_cast<int>(std::lround(static_cast<float>(plane.height) / factor))),
            width = std::max(1, static_cast<int>(std::lround(static_cast<float>(plane.width) / factor)));
  const Plane even = Blur(plane, 0.45f * factor);
  const float down = static_cast<float>(plane.height) / static_cast<float>(height),
              across = static_cast<float>(plane.width) / static_cast<float>(width);
  Plane small(height, width), large(plane.height, plane.width);
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      small.at(row, column) =
          SampleAt(even, (static_cast<float>(column) + 0.5f) * across, (static_cast<float>(row) + 0.5f) * down);
    }
  }
  for (int row = 0; row < plane.height; ++row) {
    for (int column = 0; column < plane.width; ++column) {
      large.at(row, column) =
          SampleAt(small, (static_cast<float>(column) + 0.5f) / across, (static_cast<float>(row) + 0.5f) / down);
    }
  }
  return large;
}

void ApplyTone(ColourPlanes& colours, const PhotoEffects& effects) {
  for (int channel = 0; channel < 3; ++channel) {
    for (float& value : colours[channel].values) {
      value = (value * effects.cast[channel] - 0.5f) * effects.contrast + 0.5f + effects.brightness;
      if (effects.gamma != 1) value = std::pow(std::clamp(value, 0.0f, 1.0f), effects.gamma);
    }
  }
}

void ApplyVignette(ColourPlanes& colours, float strength) {
  const int height = colours[0].height, width = colours[0].width;
  for (int row = 0; row < height; ++row) {
    const float y = 2 * (static_cast<float>(row) + 0.5f) / static_cast<float>(height) - 1;
    for (int column = 0; column < width; ++column) {
      const float x = 2 * (static_cast<float>(column) + 0.5f) / static_cast<float>(width) - 1;
      const float away = 0.5f * (x * x + y * y);
      const float left = 1 - strength * away * away;
      for (Plane& plane : colours) plane.at(row, column) *= left;
    }
  }
}

/// Light from beyond one border, which fades into the picture.
void ApplyGlare(ColourPlanes& colours, float strength, Rng& rng) {
  const int height = colours[0].height, width = colours[0].width;
  const double angle = rng.Uniform(0, 6.283185307179586);
  const float x = static_cast<float>(0.5 + 0.7 * std::cos(angle)), y = static_cast<float>(0.5 + 0.7 * std::sin(angle));
  const float warm = static_cast<float>(rng.Uniform(0.75, 1));
  const std::array<float, 3> light = {1, 0.5f + 0.5f * warm, warm};
  for (int row = 0; row < height; ++row) {
    const float down = (static_cast<float>(row) + 0.5f) / static_cast<float>(height) - y;
    for (int column = 0; column < width; ++column) {
      const float across = (static_cast<float>(column) + 0.5f) / static_cast<float>(width) - x;
      const float near = std::max(0.0f, 1 - 1.1f * std::sqrt(down * down + across * across));
      const float share = strength * near * near;
      for (int channel = 0; channel < 3; ++channel) {
        float& value = colours[channel].at(row, column);
        value += share * light[channel] * (1 - std::min(value, 1.0f));
      }
    }
  }
}

/// Beats between the pixels of a screen and those of a camera: slow waves, a little different a channel.
void ApplyMoire(ColourPlanes& colours, float amplitude, Rng& rng) {
  const int height = colours[0].height, width = colours[0].width;
  const float pixels = static_cast<float>(height) / 224.0f;
  const double angle = rng.Uniform(0, 3.141592653589793);
  const float period = static_cast<float>(rng.Uniform(5, 18)) * pixels;
  const float x = static_cast<float>(std::cos(angle)) * 6.2831853f / period,
              y = static_cast<float>(std::sin(angle)) * 6.2831853f / period;
  const float bend = static_cast<float>(rng.Uniform(0, 3)), turn = static_cast<float>(rng.Uniform(0, 2));
  const Plane warp = SmoothNoise(height, width, 90 * pixels, 90 * pixels, rng);
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const float phase = x * static_cast<float>(column) + y * static_cast<float>(row) + bend * warp.at(row, column);
      for (int channel = 0; channel < 3; ++channel) {
        colours[channel].at(row, column) *= 1 + amplitude * std::sin(phase + turn * static_cast<float>(channel));
      }
    }
  }
}

bool HasPixelEffects(const PhotoEffects& effects) {
  PhotoEffects plain;
  return effects.downscale != plain.downscale || effects.blur != 0 || effects.sharpen != 0 ||
         effects.cast != plain.cast || effects.contrast != 1 || effects.brightness != 0 || effects.gamma != 1 ||
         effects.vignette != 0 || effects.glare != 0 || effects.moire != 0 || effects.noise != 0;
}

void CheckPhotoEffects(const PhotoEffects& effects) {
  DAUMIER_CHECK(effects.downscale >= 1 && effects.downscale <= 64, "downscale is {}, expected 1 to 64",
                effects.downscale);
  DAUMIER_CHECK(effects.blur >= 0 && effects.sharpen >= 0 && effects.noise >= 0,
                "blur, sharpen or noise is negative ({}, {}, {})", effects.blur, effects.sharpen, effects.noise);
  DAUMIER_CHECK(effects.gamma > 0 && effects.contrast >= 0, "gamma is {} and contrast {}, expected positive numbers",
                effects.gamma, effects.contrast);
  DAUMIER_CHECK(effects.jpeg_quality >= 0 && effects.jpeg_quality <= 100, "jpeg_quality is {}, expected 0 to 100",
                effects.jpeg_quality);
}

}  // namespace

PhotoEffects DrawPhotoEffects(Rng& rng, const PhotoEffectOptions& options) {
  PhotoEffects effects;
  if (options.strength <= 0 || rng.Uniform() >= options.share) return effects;
  const auto draw = [&](double low, double high) { return static_cast<float>(rng.Uniform(low, high)); };
  const auto happens = [&](double share) { return rng.Uniform() < share; };
  const auto scaled = [&](double most) { return static_cast<float>(most * options.strength); };
  if (happens(options.low_resolution)) effects.downscale = draw(1.2, 3.5);
  if (happens(0.3)) effects.blur = draw(0, 1) * scaled(1.3);
  if (happens(0.2)) effects.sharpen = draw(0, 1) * scaled(0.8);
  if (happens(0.35)) {
    for (float& factor : effects.cast) factor = 1 + draw(-1, 1) * std::min(scaled(0.12), 0.5f);
  }
  if (happens(0.4)) {
    effects.contrast = std::max(0.2f, 1 + draw(-1, 1) * scaled(0.22));
    effects.brightness = draw(-1, 1) * scaled(0.08);
  }
  if (happens(0.25)) effects.gamma = std::exp(draw(-1, 1) * scaled(0.25));
  if (happens(0.2)) effects.vignette = std::min(1.0f, draw(0.1, 1) * scaled(0.5));
  if (happens(options.screen)) {
    effects.glare = std::min(1.0f, draw(0.1, 1) * scaled(0.5));
    effects.moire = std::min(1.0f, draw(0, 1) * scaled(0.06));
  }
  if (happens(0.35)) effects.noise = draw(0, 1) * scaled(0.035);
  if (happens(options.jpeg)) effects.jpeg_quality = static_cast<int>(25 + rng.Below(71));
  return effects;
}

Image ApplyPhotoEffects(const Image& image, const PhotoEffects& effects, Rng& rng) {
  DAUMIER_CHECK(image.channels == 3 && image.height > 0 && image.width > 0,
                "the picture is {} x {} with {} channels, expected RGB", image.height, image.width, image.channels);
  CheckPhotoEffects(effects);
  Image result = image;
  if (HasPixelEffects(effects)) {
    const float pixels = static_cast<float>(image.height) / 224.0f;
    ColourPlanes colours = ToPlanes(image);
    if (effects.downscale > 1) {
      for (Plane& plane : colours) plane = FromFewerPixels(plane, effects.downscale);
    }
    if (effects.blur > 0) {
      for (Plane& plane : colours) plane = Blur(plane, effects.blur * pixels);
    }
    if (effects.sharpen > 0) {
      for (Plane& plane : colours) {
        const Plane smooth = Blur(plane, pixels);
        for (size_t i = 0; i < smooth.values.size(); ++i) {
          plane.values[i] += effects.sharpen * (plane.values[i] - smooth.values[i]);
        }
      }
    }
    ApplyTone(colours, effects);
    if (effects.vignette > 0) ApplyVignette(colours, effects.vignette);
    if (effects.glare > 0) ApplyGlare(colours, effects.glare, rng);
    if (effects.moire > 0) ApplyMoire(colours, effects.moire, rng);
    if (effects.noise > 0) {
      const Plane noise = WhiteNoise(image.height, image.width, rng);
      for (Plane& plane : colours) {
        for (size_t i = 0; i < noise.values.size(); ++i) plane.values[i] += effects.noise * noise.values[i];
      }
    }
    result = ToImage(colours);
  }
  return effects.jpeg_quality > 0 ? JpegLoss(result, effects.jpeg_quality) : result;
}

}  // namespace daumier::render
