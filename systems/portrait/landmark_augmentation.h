#pragma once
#include "core/options.h"
#include "core/random.h"

#include <cstdint>
#include <span>

namespace daumier::portrait {

/// How pictures of a training vary. Shares are of samples; sizes are drawn for each sample up to the given one.
struct LandmarkAugmentationOptions {
  double strength = 1;
  double shift = 0.12;
  double scale = 0.25;
  double rotation_degrees = 30;
  double upside_down = 0.0;
  double flip = 0.5;
  double stretch = 0.3;
  double bulges = 0.5;
  double teeth = 0.4;
  double colour = 0.35;
  double tint = 0.3;
  double grey = 0.12;
  double contrast = 0.4;
  double invert = 0.0;
  double posterise = 0.06;
  double blur = 0.15;
  double coarse = 0.15;
  double occluder = 0.3;
  double noise = 0.3;
  double jpeg = 0.2;
  double line_drawing = 0.06;

  template <class V>
  void Visit(V&& visit) {
    visit("strength", strength, Range{0, 2}, "Factor of all sizes and shares below. 0: pictures are unchanged.");
    visit("shift", shift, Range{0, 0.5}, "Largest shift of the crop along each axis, as a share of its side.");
    visit("scale", scale, Range{0, 1}, "Largest logarithm of the factor of the crop's side.");
    visit("rotation_degrees", rotation_degrees, Range{0, 180},
          "Largest turn of the crop; small turns are more frequent.");
    visit("upside_down", upside_down, Range{0, 1}, "Share of samples that are turned by any angle.");
    visit("flip", flip, Range{0, 1}, "Share of samples that are mirrored, left and right landmarks exchanged.");
    visit("stretch", stretch, Range{0, 1},
          "Largest logarithm of the ratio of width to height by which crops are stretched.");
    visit("bulges", bulges, Range{0, 1}, "Share of samples with parts of the face enlarged, made smaller and moved.");
    visit("teeth", teeth, Range{0, 1}, "Share of open mouths into which teeth are painted.");
    visit("colour", colour, Range{0, 1}, "Largest logarithm of the gain of each colour channel.");
    visit("tint", tint, Range{0, 1}, "Share of samples whose channels are mixed with others.");
    visit("grey", grey, Range{0, 1}, "Share of samples without colour.");
    visit("contrast", contrast, Range{0, 1}, "Largest logarithm of the exponent of all values.");
    visit("invert", invert, Range{0, 1}, "Share of samples that are shown as negatives.");
    visit("posterise", posterise, Range{0, 1}, "Share of samples with few values a channel.");
    visit("blur", blur, Range{0, 1}, "Share of samples that are blurred.");
    visit("coarse", coarse, Range{0, 1}, "Share of samples that are made smaller and enlarged again.");
    visit("occluder", occluder, Range{0, 1}, "Share of samples with patches over the face.");
    visit("noise", noise, Range{0, 1}, "Share of samples with noise.");
    visit("jpeg", jpeg, Range{0, 1}, "Share of samples with the marks of a strong JPEG compression.");
    visit("line_drawing", line_drawing, Range{0, 1}, "Share of samples of which edges are drawn dark on light.");
  }
};

/// Values of a picture, 3 x size x size of 0..1, changed as `options` specify. A function of the picture, the options and
/// the state of `rng` alone; values stay in 0..1; with strength 0 the picture is unchanged.
void ChangeColours(std::span<float> picture, int size, const LandmarkAugmentationOptions& options, Rng& rng);

/// Paints teeth into an open mouth, where `is_mouth` marks cells x cells squares of the picture: one or two rows of light
/// teeth with gaps, from the upper border of what is marked. Nothing where less than ten squares are marked.
void PaintTeeth(std::span<float> picture, int size, std::span<const uint8_t> is_mouth, int cells, Rng& rng);

/// Draws up to four patches (rectangles, ellipses, bars) of one colour or of noise over the picture; sets covered[i] for each
/// of the `cells` x `cells` squares whose centre one covers. Patches are at most a third of the side wide, thin bars its whole width.
void DrawOccluders(std::span<float> picture, int size, std::span<uint8_t> covered, int cells, Rng& rng);

}  // namespace daumier::portrait
