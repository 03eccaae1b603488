#include "fitting/texture_picture.h"

#include "core/error.h"

#include <algorithm>
#include <array>

namespace daumier::fitting {

void DiffuseColours(int height, int width, std::span<const uint8_t> known, std::span<float> colours) {
  const size_t num_pixels = size_t(height) * size_t(width);
  DAUMIER_CHECK(known.size() == num_pixels && colours.size() == 3 * num_pixels,
                "{} colours and {} marks of a picture of {} x {} pixels", colours.size() / 3, known.size(), height,
                width);
  enum : uint8_t { kUnknown, kQueued, kKnown };
  std::vector<uint8_t> states(num_pixels);
  for (size_t i = 0; i < num_pixels; ++i) states[i] = known[i] != 0 ? kKnown : kUnknown;
  std::vector<int> level, next;
  const auto add_neighbours = [&](int pixel, std::vector<int>& to) {
    const int row = pixel / width, column = pixel % width;
    const auto add = [&](int r, int c) {
      if (r < 0 || c < 0 || r >= height || c >= width) return;
      uint8_t& state = states[size_t(r) * size_t(width) + size_t(c)];
      if (state != kUnknown) return;
      state = kQueued;
      to.push_back(r * width + c);
    };
    add(row - 1, column), add(row + 1, column), add(row, column - 1), add(row, column + 1);
  };
  for (size_t i = 0; i < num_pixels; ++i)
    if (known[i] != 0) add_neighbours(int(i), level);
  while (!level.empty()) {
    for (const int pixel : level) {
      const int row = pixel / width, column = pixel % width;
      std::array<float, 3> sum{};
      float count = 0;
      for (int r = std::max(0, row - 1); r <= std::min(height - 1, row + 1); ++r) {
        for (int c = std::max(0, column - 1); c <= std::min(width - 1, column + 1); ++c) {
          const size_t neighbour = size_t(r) * size_t(width) + size_t(c);
          if (states[neighbour] != kKnown) continue;
          for (size_t k = 0; k < 3; ++k) sum[k] += colours[3 * neighbour + k];
          ++count;
        }
      }
      for (size_t k = 0; k < 3; ++k) colours[3 * size_t(pixel) + k] = sum[k] / count;
    }
    for (const int pixel : level) states[size_t(pixel)] = kKnown;
    next.clear();
    for (const int pixel : level) add_neighbours(pixel, next);
    std::swap(level, next);
  }
}

std::vector<float> DistanceFromOutside(int height, int width, std::span<const uint8_t> inside) {
  DAUMIER_CHECK(inside.size() == size_t(height) * size_t(width), "{} marks of a picture of {} x {} pixels",
                inside.size(), height, width);
  constexpr float kDiagonal = 4.0F / 3.0F;
  std::vector<float> distance(inside.size());
  const auto at = [&](int row, int column) -> float& { return distance[size_t(row) * size_t(width) + size_t(column)]; };
  for (size_t i = 0; i < inside.size(); ++i) distance[i] = inside[i] != 0 ? float(height + width) : 0.0F;
  const auto pass = [&](int row, int column, int step) {
    float& d = at(row, column);
    const bool has_side = column - step >= 0 && column - step < width;
    if (has_side) d = std::min(d, at(row, column - step) + 1);
    if (row - step < 0 || row - step >= height) return;
    d = std::min(d, at(row - step, column) + 1);
    for (const int side : {-1, 1})
      if (column + side >= 0 && column + side < width) d = std::min(d, at(row - step, column + side) + kDiagonal);
  };
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) pass(row, column, 1);
  for (int row = height; row-- > 0;)
    for (int column = width; column-- > 0;) pass(row, column, -1);
  return distance;
}

PictureLayer LayerOf(const render::Image& picture, const render::Image& mask, const ClassSet& classes, double margin) {
  DAUMIER_CHECK(
      picture.channels == 3 && mask.channels == 1 && picture.height == mask.height && picture.width == mask.width,
      "a picture of {} x {} x {} with a mask of {} x {} x {}, expected RGB and grey of one size", picture.height,
      picture.width, picture.channels, mask.height, mask.width, mask.channels);
  PictureLayer layer{picture.height, picture.width, {}, {}, 0};
  layer.colours.resize(picture.pixels.size());
  std::ranges::transform(picture.pixels, layer.colours.begin(), [](uint8_t value) { return float(value) / 255.0F; });
  std::vector<uint8_t> inside(mask.pixels.size());
  std::ranges::transform(mask.pixels, inside.begin(), [&](uint8_t value) { return uint8_t(classes.holds(value)); });
  const std::vector<float> distance = DistanceFromOutside(layer.height, layer.width, inside);
  // Distances count from the middles of pixels: the border is half a pixel nearer.
  const auto border = float(std::max(margin, 0.0)) + 0.5F, ramp = std::max(float(margin), 1.0F);
  layer.confidence.resize(inside.size());
  for (size_t i = 0; i < inside.size(); ++i) {
    layer.confidence[i] = std::clamp((distance[i] - border) / ramp, 0.0F, 1.0F);
    inside[i] = distance[i] >= border;
    layer.num_known += inside[i];
  }
  DiffuseColours(layer.height, layer.width, inside, layer.colours);
  return layer;
}

void DoubtOverexposed(const render::Image& picture, PictureLayer& layer) {
  constexpr uint8_t kOverexposed = 252, kWhitePixel = 240;
  constexpr float kDoubt = 0.1F;
  DAUMIER_CHECK(picture.channels == 3 && picture.height == layer.height && picture.width == layer.width,
                "a picture of {} x {} x {} with a layer of {} x {}", picture.height, picture.width, picture.channels,
                layer.height, layer.width);
  const auto is_white = [&](size_t i) {
    const uint8_t* const c = picture.pixels.data() + 3 * i;
    return std::min({c[0], c[1], c[2]}) >= kWhitePixel;
  };
  size_t num_known = 0, num_white = 0;
  for (size_t i = 0; i < layer.confidence.size(); ++i) {
    if (layer.confidence[i] <= 0) continue;
    ++num_known, num_white += is_white(i);
  }
  for (size_t i = 0; i < layer.confidence.size(); ++i) {
    const uint8_t* const c = picture.pixels.data() + 3 * i;
    if (2 * num_white < num_known && is_white(i)) layer.confidence[i] = 0;
    if (std::max({c[0], c[1], c[2]}) >= kOverexposed) layer.confidence[i] *= kDoubt;
  }
}

}  // namespace daumier::fitting
