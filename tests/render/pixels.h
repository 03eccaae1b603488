#pragma once
#include "render/image.h"

#include <algorithm>
#include <cstdlib>

namespace daumier::render {

inline constexpr Rgb kWhite = {255, 255, 255}, kBlack = {0, 0, 0};

inline Rgb Pixel(const Image& image, int row, int column) {
  return {image.at(row, column, 0), image.at(row, column, 1), image.at(row, column, 2)};
}

/// Of two images of the same size.
inline int LargestDifference(const Image& a, const Image& b) {
  int largest = 0;
  for (size_t i = 0; i < a.pixels.size(); ++i) largest = std::max(largest, std::abs(a.pixels[i] - b.pixels[i]));
  return largest;
}

}  // namespace daumier::render
