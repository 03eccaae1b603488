#pragma once
#include "core/options.h"
#include "render/image.h"

namespace daumier::render {

struct ToonPictureOptions {
  double reach = 0.012;
  double contrast = 0.15;
  int bands = 8;
  double saturation = 1.2;

  template <class V>
  void Visit(V&& visit) {
    visit("reach", reach, Range{0, 0.5}, "How far colours are smoothed, a share of the picture's longer side.");
    visit("contrast", contrast, Range{0.01, 10}, "Steps of colour (0 .. 1) that are kept as borders.");
    visit("bands", bands, Range{0, 256}, "Bands of lightness; 0 leaves it as it is.");
    visit("saturation", saturation, Range{0, 4}, "Factor of the colours' distance from grey.");
  }
};

/// A picture as flat colours with borders: smoothed within borders by the recursive filter of the domain transform
/// [Gastal and Oliveira 2011, section 4, three rounds], then the lightness Y in soft bands of the height h = 1 / bands,
///   Y' = b + h/2 tanh(4 (Y - b) / h) / tanh(2),  b the multiple of h that is nearest to Y [Winnemoeller et al. 2006,
/// section 4], and colours Y' + saturation (c - Y), clamped. Values are sRGB in 0 .. 1, Y their luma.
/// RGB or grey in, RGB out. Promises: a picture of one colour stays one; flat areas at a border that is much larger than
/// `contrast` do not mix; the same picture gives the same bytes with any number of threads.
/// @throws Error if the picture is empty.
Image ToonPicture(const Image& picture, const ToonPictureOptions& options = {});

}  // namespace daumier::render
