#pragma once
#include "core/options.h"
#include "render/styles/toon_picture.h"

#include <optional>
#include <span>
#include <vector>

namespace daumier::portrait {

struct ToonPortraitOptions {
  render::ToonPictureOptions colours;
  double eyes = 0.35;

  template <class V>
  void Visit(V&& visit) {
    visit("colours", colours, Table{}, "Flat colours.");
    visit("eyes", eyes, Range{0, 0.6}, "Eyes are shown larger by 1 / (1 - eyes) in their middle; 0 leaves them.");
  }
};

/// A picture of a face as a cartoon, and where things are in it.
struct ToonPortrait {
  render::Image picture;                   ///< Of the same size, RGB.
  std::vector<float> landmarks;            ///< 68 x 2, pixels.
  std::optional<render::Image> mask = {};  ///< PictureClass of each pixel.
};

/// render::ToonPicture with larger eyes: a Bulge about the middle of each eye's landmarks, its radius the eye's width or
/// half of the distance between the eyes, whichever is less. What is outside of these discs stays where it is. In place of
/// the stylisation of [Pan et al. 2024, section 3.1.3], whose weights are not to be had.
/// landmarks: 68 x 2, pixels; mask: of the picture's size, or null. @throws Error if there are not 68.
ToonPortrait MakeToonPortrait(const render::Image& picture, std::span<const float> landmarks, const render::Image* mask,
                              const ToonPortraitOptions& options = {});

}  // namespace daumier::portrait
