#include "render/styles/light_layers.h"
#include "render/styles/surface_colours.h"

#include <algorithm>
#include <cmath>

namespace daumier::render {
namespace {

constexpr float kShoulder = 0.85f;  ///< Values above are compressed.

float Compressed(float value) {
  if (value <= kShoulder) return value;
  const float above = value - kShoulder;
  return kShoulder + (1 - kShoulder) * above / (above + (1 - kShoulder));
}

float RaisedTo16(float value) {
  value *= value;
  value *= value;
  value *= value;
  return value * value;
}

float SmoothStep(float from, float to, float value) {
  const float t = std::clamp((value - from) / (to - from), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

bool IsSkinLike(uint8_t picture_class) {
  switch (static_cast<PictureClass>(picture_class)) {
    case PictureClass::kSkin:
    case PictureClass::kEars:
    case PictureClass::kLips:
      return true;
    default:
      return false;
  }
}

bool HasPart(const PictureLayers& layers, PicturePart part) {
  return std::find(layers.parts.begin(), layers.parts.end(), static_cast<uint8_t>(part)) != layers.parts.end();
}

/// Strength of the highlight of a part, by the cosine between its normal and the half vector and by the cosine to the
/// viewer.
float HighlightOf(PicturePart part, bool is_lip, float half_cosine, float facing, float up, bool eyes_have_spots) {
  const float sharp = RaisedTo16(half_cosine);
  switch (part) {
    case PicturePart::kSkin:
    case PicturePart::kLidRim:
      return is_lip ? 0.30f * sharp * sharp * sharp : 0.10f * sharp;
    case PicturePart::kEyeball:
      return eyes_have_spots ? 0.15f * SmoothStep(0.93f, 0.97f, half_cosine)
                             : 0.9f * SmoothStep(0.975f, 0.985f, half_cosine);
    case PicturePart::kMouth:
    case PicturePart::kTeeth:
      return 0.3f * sharp * sharp;
    case PicturePart::kHair: {
      // A ring around the head where the normal tilts upwards, as combed hair has.
      const float ring = (up - 0.45f) * (1 / 0.16f);
      return 0.22f * std::max(0.0f, 1 - ring * ring) * facing;
    }
    case PicturePart::kHat:
      return 0.05f * sharp;
    case PicturePart::kGlasses:
      return 0.6f * sharp * sharp;
    case PicturePart::kLens:
      return 0.5f * SmoothStep(0.90f, 0.97f, half_cosine);
    default:
      return 0;
  }
}

}  // namespace

ColourPlanes SmoothColours(const PictureLayers& layers, const StyleChoice& choice) {
  const auto light = MainLight(layers);
  const ShadeRange range = RangeOfShade(layers);
  const float span = std::max(range.lightest, 0.2f);
  const Plane none;
  const Plane occlusion = choice.occlusion > 0 ? Occlusion(layers) : none;
  const Plane shadow = choice.shadows > 0 ? CastShadows(layers, light) : none;
  // Half of the way from the light to the viewer; the light is first turned towards the viewer, so that highlights of
  // eyes are not hidden behind lids.
  std::array<float, 3> half = {light[0] * 0.6f, light[1] * 0.6f, light[2] * 0.6f + 1};
  const float length = std::sqrt(half[0] * half[0] + half[1] * half[1] + half[2] * half[2]);
  for (float& value : half) value /= length;
  const float side = std::hypot(light[0], light[1]) + 1e-3f;
  const std::array<float, 2> behind = {-light[0] / side, -light[1] / side + 0.4f};
  const bool eyes_have_spots = HasPart(layers, PicturePart::kHighlight);

  ColourPlanes colours = MakeColourPlanes(layers.height, layers.width, {0, 0, 0});
  for (size_t i = 0; i < layers.size(); ++i) {
    if (layers.coverage.values[i] == 0) continue;
    const auto part = static_cast<PicturePart>(layers.parts[i]);
    const float x = layers.normal[0].values[i], y = layers.normal[1].values[i], z = layers.normal[2].values[i];
    float level = layers.shade.values[i];
    if (part == PicturePart::kHighlight) level = 1;
    const float wrapped = std::clamp(0.7f * (x * light[0] + y * light[1] + z * light[2]) + 0.3f, 0.0f, 1.0f);
    level *= 1 + choice.key * (wrapped - 0.6f);
    if (choice.occlusion > 0) level *= 1 - choice.occlusion * occlusion.values[i];
    if (choice.shadows > 0) level *= 1 - choice.shadows * shadow.values[i];
    level = std::max(level, 0.0f);
    const bool is_skin = IsSkinLike(layers.classes[i]);
    const float dim = is_skin ? choice.warm_shade * std::clamp(1 - level / span, 0.0f, 1.0f) : 0.0f;
    const std::array<float, 3> warmth = {1 + 0.16f * dim, 1 - 0.10f * dim, 1 - 0.12f * dim};

    float shine = 0;
    if (choice.gloss > 0) {
      const float cosine = std::max(0.0f, x * half[0] + y * half[1] + z * half[2]);
      const bool is_lip = layers.classes[i] == static_cast<uint8_t>(PictureClass::kLips);
      shine = choice.gloss * HighlightOf(part, is_lip, cosine, std::max(z, 0.0f), y, eyes_have_spots);
      if (choice.shadows > 0 && part != PicturePart::kEyeball) shine *= 1 - choice.shadows * shadow.values[i];
    }
    float edge = 0;
    if (choice.rim > 0 && part != PicturePart::kEyeball) {
      const float away = 1 - std::clamp(z, 0.0f, 1.0f);
      edge = choice.rim * 0.8f * away * away * away * std::max(0.0f, x * behind[0] + y * behind[1]);
    }
    for (int channel = 0; channel < 3; ++channel) {
      float value = layers.albedo[channel].values[i] * level * warmth[channel];
      // The rim takes half of the surface's own colour.
      value += edge * (0.5f + 0.5f * layers.albedo[channel].values[i]);
      value += shine * (1 - std::min(value, 1.0f));
      colours[channel].values[i] = Compressed(value);
    }
  }
  return colours;
}

PictureLayers WithClay(PictureLayers layers, const std::array<float, 3>& clay) {
  for (int channel = 0; channel < 3; ++channel) {
    for (size_t i = 0; i < layers.size(); ++i) {
      layers.albedo[channel].values[i] = layers.coverage.values[i] > 0 ? clay[channel] : 0.0f;
    }
  }
  // Spots on eyes are no material.
  for (uint8_t& part : layers.parts) {
    if (part == static_cast<uint8_t>(PicturePart::kHighlight)) part = static_cast<uint8_t>(PicturePart::kEyeball);
  }
  return layers;
}

}  // namespace daumier::render
