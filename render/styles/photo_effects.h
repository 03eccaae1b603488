#pragma once
#include "core/options.h"
#include "core/random.h"
#include "render/image.h"

#include <array>

namespace daumier::render {

/// What happens to a picture between the artist and the file. All at their defaults: nothing.
/// Lengths are pixels of a picture 224 high.
struct PhotoEffects {
  float downscale = 1;                    ///< Shrunk by this factor and enlarged again, >= 1.
  float blur = 0;                         ///< Standard deviation, pixels.
  float sharpen = 0;                      ///< Unsharp mask: added share of what a blur of 1 pixel removes.
  std::array<float, 3> cast = {1, 1, 1};  ///< Factor of each channel.
  float contrast = 1;                     ///< About 0.5.
  float brightness = 0;                   ///< Added; 1 is white.
  float gamma = 1;                        ///< Exponent of the values in 0..1.
  float vignette = 0;                     ///< Darkening of the corners, 0..1.
  float glare = 0;                        ///< Soft light from a random side, 0..1 at its brightest.
  float moire = 0;                        ///< Amplitude of the beats of a photographed screen, 0..1.
  float noise = 0;                        ///< Standard deviation, 1 is white.
  int jpeg_quality = 0;                   ///< 1..100; 0: none.
};

struct PhotoEffectOptions {
  double strength = 1;
  double share = 0.75;
  double jpeg = 0.5;
  double low_resolution = 0.15;
  double screen = 0.05;

  template <class V>
  void Visit(V&& visit) {
    visit("strength", strength, Range{0, 3}, "Factor of blur, noise, colour cast, contrast and the like; 0: none.");
    visit("share", share, Range{0, 1}, "Share of pictures with any effect.");
    visit("jpeg", jpeg, Range{0, 1}, "Share of those that are compressed as JPEG does, quality 25 to 95.");
    visit("low_resolution", low_resolution, Range{0, 1}, "Share of those that are enlarged from fewer pixels.");
    visit("screen", screen, Range{0, 1}, "Share of those that look photographed from a screen or under a lamp.");
  }
};

/// With strength 0 or share 0: no effect.
PhotoEffects DrawPhotoEffects(Rng& rng, const PhotoEffectOptions& options);

/// The picture with all effects, in the order of the fields; noise and places from `rng`. Without effects it returns
/// the same bytes. Noise is grey. Without cast, glare and moire, grey pictures stay grey (to 1 of 255 after JPEG).
/// @throws Error if the picture is not RGB or empty, or a field is out of its range.
Image ApplyPhotoEffects(const Image& image, const PhotoEffects& effects, Rng& rng);

}  // namespace daumier::render
