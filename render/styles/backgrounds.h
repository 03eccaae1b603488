#pragma once
#include "core/random.h"
#include "render/styles/colour_planes.h"

#include <array>
#include <string_view>

namespace daumier::render {

/// What is behind a portrait. None of them has anything like a face.
enum class BackgroundKind {
  kFlat,      ///< One colour.
  kGradient,  ///< Between two colours, straight or around a point.
  kClouds,    ///< Smooth noise between two colours.
  kPaper,     ///< Near white with grain.
  kDots,      ///< A screen of dots.
  kStripes,   ///< Straight or radial stripes.
  kShapes,    ///< Circles, boxes and bars that overlap.
  kRoom,      ///< Wall, floor, a window or a frame, out of focus or drawn.
  kFoliage,   ///< Blobs of leaves before a sky.
  kHills,     ///< Sky, clouds and layers of hills.
};
inline constexpr int kNumBackgroundKinds = 10;

std::string_view NameOf(BackgroundKind kind);

struct BackgroundChoice {
  BackgroundKind kind = BackgroundKind::kFlat;
  std::array<float, 3> first = {0.85f, 0.87f, 0.88f};  ///< RGB in 0..1.
  std::array<float, 3> second = {0.6f, 0.68f, 0.74f};
  std::array<float, 3> third = {0.93f, 0.8f, 0.6f};
  float scale = 1;  ///< Of what is in it, 0.5..2.
  float blur = 0;   ///< Standard deviation, pixels of a picture 224 high: out of focus.
};

/// Colours from a few harmonies, light and dark, muted and bright. `busy`: share of kinds other than kFlat, kGradient
/// and kPaper.
BackgroundChoice DrawBackgroundChoice(Rng& rng, double busy);

/// A background of a size; places and noise from `rng`. @throws Error if a size is not positive.
ColourPlanes DrawBackground(const BackgroundChoice& choice, int height, int width, Rng& rng);

}  // namespace daumier::render
