#include "render/styles/light_layers.h"
#include "render/styles/surface_colours.h"

#include <algorithm>
#include <cmath>

namespace daumier::render {
namespace {

constexpr float kToonShadeBlur = 2;       ///< Units.
constexpr float kLeastToonRange = 0.25f;  ///< Share of the lightest: a smaller range of light is no reason for bands.
constexpr float kToonAlbedo = 0.4f;       ///< Share of the albedo in toon colours; the rest is flat.

/// Regions of one colour; -1 keeps the albedo.
enum FlatRegion { kFlatSkin, kFlatBrows, kFlatLips, kFlatMouth, kFlatHair, kFlatBeard, kFlatHat, kFlatGlasses };
constexpr int kNumFlatRegions = 8;

int FlatRegionOf(uint8_t picture_class, uint8_t part) {
  switch (static_cast<PicturePart>(part)) {
    case PicturePart::kHair:
      return kFlatHair;
    case PicturePart::kBeard:
      return kFlatBeard;
    case PicturePart::kGlasses:
      return kFlatGlasses;
    case PicturePart::kBrow:
      return kFlatBrows;
    case PicturePart::kSkin:
    case PicturePart::kLidRim:
    case PicturePart::kMouth:
      break;
    default:
      return -1;
  }
  switch (static_cast<PictureClass>(picture_class)) {
    case PictureClass::kSkin:
    case PictureClass::kEars:
      return kFlatSkin;
    case PictureClass::kBrows:
      return kFlatBrows;
    case PictureClass::kLips:
      return kFlatLips;
    case PictureClass::kMouth:
      return kFlatMouth;
    case PictureClass::kHair:
      return kFlatHair;
    default:
      return -1;
  }
}

/// Paints the colour of a region of the skin over it with a smooth border.
void PaintRegion(const std::vector<int8_t>& regions, int region, const std::array<float, 3>& colour, float deviation,
                 const PictureLayers& layers, ColourPlanes& colours) {
  Plane mask(layers.height, layers.width);
  for (size_t i = 0; i < regions.size(); ++i) mask.values[i] = regions[i] == region ? 1.0f : 0.0f;
  mask = Blur(mask, deviation);
  for (size_t i = 0; i < regions.size(); ++i) {
    if (regions[i] != kFlatSkin && regions[i] != region) continue;
    const float share = std::clamp((mask.values[i] - 0.5f) * 3 + 0.5f, 0.0f, 1.0f);
    for (int channel = 0; channel < 3; ++channel) {
      float& value = colours[channel].values[i];
      value += share * (colour[channel] - value);
    }
  }
}

}  // namespace

float QuantisedLight(float value, int bands, float softness) {
  float level = 0;
  for (int i = 1; i < bands; ++i) {
    const float from = static_cast<float>(i) / static_cast<float>(bands);
    const float t = std::clamp((value - from) / std::max(softness, 1e-6f) + 0.5f, 0.0f, 1.0f);
    level += t * t * (3 - 2 * t);
  }
  return bands > 1 ? level / static_cast<float>(bands - 1) : 1.0f;
}

ColourPlanes FlatColours(const PictureLayers& layers) {
  std::vector<int8_t> regions(layers.size());
  std::array<std::array<double, 4>, kNumFlatRegions> sums{};
  for (size_t i = 0; i < layers.size(); ++i) {
    const bool is_covered = layers.coverage.values[i] > 0;
    regions[i] = static_cast<int8_t>(is_covered ? FlatRegionOf(layers.classes[i], layers.parts[i]) : -1);
    if (regions[i] < 0) continue;
    auto& sum = sums[regions[i]];
    for (int channel = 0; channel < 3; ++channel) sum[channel] += double(layers.albedo[channel].values[i]);
    sum[3] += 1;
  }
  std::array<std::array<float, 3>, kNumFlatRegions> means{};
  for (int region = 0; region < kNumFlatRegions; ++region) {
    for (int channel = 0; channel < 3; ++channel) {
      means[region][channel] = static_cast<float>(sums[region][channel] / std::max(sums[region][3], 1.0));
    }
  }
  ColourPlanes colours = layers.albedo;
  const bool has_skin = sums[kFlatSkin][3] > 0;
  for (size_t i = 0; i < layers.size(); ++i) {
    if (regions[i] < 0) continue;
    // Brows and lips are painted upon the skin.
    const bool is_upon_skin = regions[i] == kFlatBrows || regions[i] == kFlatLips;
    const auto& mean = means[is_upon_skin && has_skin ? int(kFlatSkin) : int(regions[i])];
    for (int channel = 0; channel < 3; ++channel) colours[channel].values[i] = mean[channel];
  }
  for (const int region : {kFlatBrows, kFlatLips}) {
    if (sums[region][3] == 0 || !has_skin) continue;
    PaintRegion(regions, region, means[region], 0.9f * layers.scale, layers, colours);
  }
  return colours;
}

Plane ToonLight(const PictureLayers& layers, const StyleChoice& choice) {
  Plane shade = SmoothShade(layers, kToonShadeBlur);
  const ShadeRange range = RangeOfShade(layers);
  const float least = kLeastToonRange * std::max(range.lightest, 1e-3f);
  const float darkest = std::min(range.darkest, range.lightest - least);
  const float scale = 1 / (range.lightest - darkest);
  const Plane shadow = choice.shadows > 0 ? CastShadows(layers, MainLight(layers)) : Plane(layers.height, layers.width);
  for (int row = 0; row < layers.height; ++row) {
    for (int column = 0; column < layers.width; ++column) {
      const size_t i = size_t(row) * layers.width + column;
      if (layers.coverage.values[i] == 0) {
        shade.values[i] = 1;
        continue;
      }
      // Light of 0.4 of the range is at the middle of two bands: shadows take the smaller share of a face.
      const float value = (shade.values[i] - darkest) * scale + 0.1f;
      const float lit = choice.shadows > 0 ? std::clamp(1.5f - 2 * shadow.values[i], 0.0f, 1.0f) : 1.0f;
      const float softness = std::max(choice.band_softness, 0.02f);
      shade.values[i] = QuantisedLight(value, choice.bands, softness) * (lit * lit * (3 - 2 * lit));
    }
  }
  return shade;
}

ColourPlanes ToonColours(const PictureLayers& layers, const StyleChoice& choice) {
  ColourPlanes colours = FlatColours(layers);
  const Plane levels = ToonLight(layers, choice);
  const ShadeRange range = RangeOfShade(layers);
  const float exposure = std::clamp(range.lightest, 0.75f, 1.05f);
  for (int channel = 0; channel < 3; ++channel) {
    const float darkest = (1 - choice.band_depth) * choice.shadow_hue[channel];
    for (size_t i = 0; i < layers.size(); ++i) {
      if (layers.coverage.values[i] == 0) continue;
      const bool is_spot = layers.parts[i] == static_cast<uint8_t>(PicturePart::kHighlight);
      const float factor = is_spot ? 1.0f : exposure * (darkest + (1 - darkest) * levels.values[i]);
      float& value = colours[channel].values[i];
      value = (value + kToonAlbedo * (layers.albedo[channel].values[i] - value)) * factor;
    }
  }
  return colours;
}

}  // namespace daumier::render
