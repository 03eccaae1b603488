#pragma once
#include "core/picture_parts.h"
#include "render/image.h"

#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

namespace daumier::fitting {

/// Replaces each unknown pixel by the mean of those of its 8 neighbours that are known already, breadth first from the
/// known ones over 4-neighbours [Pan et al. 2024, section 3.2.3]. Pixels of one distance do not see each other, so that
/// the result does not depend on their order. colours: height x width x 3, changed where `known` (height x width) is 0.
/// Without a known pixel nothing changes. @throws Error if a size disagrees.
void DiffuseColours(int height, int width, std::span<const uint8_t> known, std::span<float> colours);

/// Distance to the nearest pixel whose `inside` is 0, pixels, in steps of 1 along an axis and 4 / 3 along a diagonal:
/// 0 outside, 1 next to it. Where all pixels are inside: height + width. What is beyond the picture does not count.
std::vector<float> DistanceFromOutside(int height, int width, std::span<const uint8_t> inside);

/// A set of PictureClass.
class ClassSet {
 public:
  ClassSet(std::initializer_list<PictureClass> classes) {
    for (const PictureClass c : classes) bits_ |= 1u << unsigned(c);
  }
  bool holds(uint8_t of_mask) const { return of_mask < kNumPictureClasses && (bits_ >> of_mask & 1u) != 0; }

 private:
  unsigned bits_ = 0;
};

/// What a picture shows of some classes, continued beyond their border by diffusion, so that a sample next to the border
/// has none of the colour behind it.
struct PictureLayer {
  int height = 0, width = 0;
  std::vector<float> colours;  ///< height x width x 3, RGB 0 .. 1.
  std::vector<float>
      confidence;     ///< height x width: 0 up to `margin` pixels inside of the border, 1 from twice that on.
  int num_known = 0;  ///< Pixels that are farther than `margin` from the border.
};

/// mask: PictureClass, grey, of the picture's size. Colours of the pixels within `margin` of the border are diffused too:
/// there they mix with what is behind. @throws Error if the sizes disagree, the picture is not RGB, or the mask not grey.
PictureLayer LayerOf(const render::Image& picture, const render::Image& mask, const ClassSet& classes, double margin);

/// Reduces the confidence of pixels of which a channel is at its end (252 or more) to a tenth: their hue is not that of the
/// surface, and shows once they are divided by their light. White ones (all channels at least 240) have none, unless half of the
/// layer is white: they are highlights and bright backgrounds. @throws Error if the sizes disagree or the picture is not RGB.
void DoubtOverexposed(const render::Image& picture, PictureLayer& layer);

}  // namespace daumier::fitting
