#pragma once
#include <cstdint>

namespace daumier::faces {

/// Classes of parsing masks. Hats, glasses and clothes are background: they hide the face.
enum class MaskClass : uint8_t { kBackground, kSkin, kBrows, kEyes, kLips, kMouth, kEars, kHair };
inline constexpr int kNumMaskClasses = 8;

/// What a triangle is made of: for gloss, line weights, light from both sides.
enum class PortraitPart : uint8_t {
  kSkin,
  kEyeball,
  kHighlight,
  kLidRim,
  kLash,
  kBrow,
  kMouth,
  kTeeth,
  kHair,
  kBeard,
  kHat,
  kGlasses,
  kLens,
  kClothes
};

}  // namespace daumier::faces
