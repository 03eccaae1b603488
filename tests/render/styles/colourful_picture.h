#pragma once
#include "render/image.h"

#include <cmath>

namespace daumier::testing {

/// Two ramps and a chequerboard.
inline render::Image ColourfulPicture(int height = 40, int width = 56) {
  render::Image image(height, width, 3);
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      image.at(row, column, 0) = static_cast<uint8_t>(255 * column / width);
      image.at(row, column, 1) = static_cast<uint8_t>(255 * row / height);
      image.at(row, column, 2) = (row / 8 + column / 8) % 2 ? 200 : 40;
    }
  }
  return image;
}

inline double RootMeanSquare(const render::Image& first, const render::Image& second) {
  double sum = 0;
  for (size_t i = 0; i < first.pixels.size(); ++i) sum += std::pow(double(first.pixels[i]) - second.pixels[i], 2);
  return std::sqrt(sum / static_cast<double>(first.pixels.size()));
}

}  // namespace daumier::testing
