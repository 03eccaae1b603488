#pragma once
#include "render/styles/picture_layers.h"
#include "render/styles/style_choice.h"

namespace daumier::render {

/// Steps of a value in 0..1: `bands` levels 0, 1 / (bands - 1), ... 1, which change at i / bands for i = 1 .. bands - 1,
/// each over a smoothstep of width `softness`. Below 0 and above 1 it is 0 and 1.
float QuantisedLight(float value, int bands, float softness);

/// Colours of what is covered (means over covered samples, not multiplied by coverage). All of them leave pixels that
/// are not covered black.

/// albedo * shade, with the choice's key light, occlusion, shadows, highlights and rim; values above 0.85 are compressed
/// towards 1. With key, occlusion, shadows, gloss, rim and warm_shade 0 it is albedo * shade below that.
ColourPlanes SmoothColours(const PictureLayers& layers, const StyleChoice& choice);

/// One colour a region: the mean albedo of skin and ears, brows, lips, inside of the mouth, hair, each hat and pair of
/// glasses. Eyes, lashes and teeth keep their albedo. Borders of brows and lips are smoothed. The shade is not read.
ColourPlanes FlatColours(const PictureLayers& layers);

/// Flat colours (in part the albedo) in `bands` levels of light: shade smoothed over about 2 units, cast shadows, spread
/// from the darkest to the lightest (RangeOfShade); the darkest band is multiplied by (1 - band_depth) shadow_hue.
ColourPlanes ToonColours(const PictureLayers& layers, const StyleChoice& choice);

/// The levels that ToonColours uses, 0 darkest to 1 lightest; 1 where nothing is covered.
Plane ToonLight(const PictureLayers& layers, const StyleChoice& choice);

/// The choice's clay in the place of all albedo.
PictureLayers WithClay(PictureLayers layers, const std::array<float, 3>& clay);

}  // namespace daumier::render
