#pragma once
#include <cstdint>

/// What a picture of a face shows: of pixels of parsing masks and G-buffers, and of triangles of a head that is portrayed.
namespace daumier {

/// Classes of parsing masks, in the order of a network's labels and of masks in files. Hats, glasses and clothes are
/// background: they hide the face.
enum class PictureClass : uint8_t { kBackground, kSkin, kBrows, kEyes, kLips, kMouth, kEars, kHair };
inline constexpr int kNumPictureClasses = 8;

/// What a pixel or a triangle is made of: for gloss, for borders between things, for light from both sides. kHighlight:
/// white spots on eyes, which light does not change.
enum class PicturePart : uint8_t {
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
inline constexpr int kNumPictureParts = 14;

}  // namespace daumier
