#include "systems/portrait/landmark_clutter.h"

#include "core/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace daumier::portrait {
namespace {

using Colour = std::array<float, 3>;

/// Any colour; half of them are near grey or skin.
Colour DrawColour(Rng& rng) {
  if (rng.Below(2) == 0) return {float(rng.Uniform()), float(rng.Uniform()), float(rng.Uniform())};
  const double light = rng.Uniform(), warm = rng.Uniform(-0.05, 0.2);
  return {float(std::min(1.0, light + warm)), float(light), float(std::max(0.0, light - warm))};
}

class Canvas {
 public:
  Canvas(std::span<float> values, int size) : values_(values), size_(size) {}

  int size() const { return size_; }
  void Set(int row, int column, const Colour& colour, float share = 1) {
    const size_t count = size_t(size_) * size_t(size_), at = size_t(row) * size_t(size_) + size_t(column);
    for (size_t k = 0; k < 3; ++k) {
      float& value = values_[k * count + at];
      value = std::clamp(value + share * (colour[k] - value), 0.0f, 1.0f);
    }
  }
  /// Where `inside` holds at the pixel's centre, in units of the side.
  template <class Inside>
  void Fill(double left, double top, double right, double bottom, const Colour& colour, const Inside& inside) {
    const auto bound = [&](double value) { return std::clamp(int(value * size_), 0, size_); };
    for (int row = bound(top); row < bound(bottom); ++row)
      for (int column = bound(left); column < bound(right); ++column)
        if (inside((column + 0.5) / size_, (row + 0.5) / size_)) Set(row, column, colour);
  }

 private:
  std::span<float> values_;
  int size_;
};

/// Values on a coarse grid, enlarged bilinearly, added in several scales.
void DrawClouds(Canvas& canvas, Rng& rng) {
  const Colour a = DrawColour(rng), b = DrawColour(rng);
  const int size = canvas.size();
  std::vector<float> field(size_t(size) * size_t(size), 0);
  for (int cells = 2 + int(rng.Below(3)); cells < size / 2; cells *= 2 + int(rng.Below(2))) {
    std::vector<float> grid(size_t(cells + 1) * size_t(cells + 1));
    for (float& value : grid) value = float(rng.Uniform(-1, 1));
    const float weight = 1.2f / std::sqrt(float(cells));
    for (int row = 0; row < size; ++row)
      for (int column = 0; column < size; ++column) {
        const float x = float(column) * float(cells) / float(size), y = float(row) * float(cells) / float(size);
        const int c = int(x), r = int(y);
        const float u = x - float(c), v = y - float(r);
        const float* const at = &grid[size_t(r) * size_t(cells + 1) + size_t(c)];
        const float* const below = at + cells + 1;
        field[size_t(row) * size_t(size) + size_t(column)] +=
            weight * ((1 - v) * ((1 - u) * at[0] + u * at[1]) + v * ((1 - u) * below[0] + u * below[1]));
      }
  }
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column) {
      canvas.Set(row, column, a);
      canvas.Set(row, column, b, std::clamp(0.5f + field[size_t(row) * size_t(size) + size_t(column)], 0.0f, 1.0f));
    }
}

void DrawGround(Canvas& canvas, Rng& rng) {
  const uint64_t kind = rng.Below(5);
  if (kind == 0) return DrawClouds(canvas, rng);
  const Colour a = DrawColour(rng), b = DrawColour(rng);
  const double angle = rng.Uniform(0, 2 * std::numbers::pi), dx = std::cos(angle), dy = std::sin(angle);
  const double period = rng.Uniform(0.04, 0.5);
  for (int row = 0; row < canvas.size(); ++row)
    for (int column = 0; column < canvas.size(); ++column) {
      const double x = (column + 0.5) / canvas.size() - 0.5, y = (row + 0.5) / canvas.size() - 0.5;
      const double along = dx * x + dy * y, across = dy * x - dx * y;
      canvas.Set(row, column, a);
      const auto odd = [&](double value) { return (int64_t(std::floor(value / period)) & 1) != 0; };
      if (kind == 2) canvas.Set(row, column, b, float(std::clamp(along + 0.5, 0.0, 1.0)));
      if (kind == 3 && odd(along)) canvas.Set(row, column, b);
      if (kind == 4 && odd(along) != odd(across)) canvas.Set(row, column, b);
    }
}

void DrawThing(Canvas& canvas, Rng& rng) {
  const Colour colour = DrawColour(rng);
  const double x = rng.Uniform(), y = rng.Uniform(), w = rng.Uniform(0.01, 0.3), h = rng.Uniform(0.01, 0.3);
  const double angle = rng.Uniform(0, 2 * std::numbers::pi), c = std::cos(angle), s = std::sin(angle);
  const double reach = std::hypot(w, h);
  const auto fill = [&](double at_x, double at_y, const auto& inside) {
    canvas.Fill(at_x - reach, at_y - reach, at_x + reach, at_y + reach, colour, [&](double px, double py) {
      return inside(c * (px - at_x) + s * (py - at_y), c * (py - at_y) - s * (px - at_x));
    });
  };
  const auto disc = [&](double u, double v) { return u * u / (w * w) + v * v / (h * h) < 1; };
  switch (rng.Below(6)) {
    case 0:
      return fill(x, y, disc);
    case 1:  // A ring, or an arc.
      return fill(x, y, [&, low = rng.Uniform(0.5, 0.9), cut = rng.Uniform(-1, 1)](double u, double v) {
        const double r = u * u / (w * w) + v * v / (h * h);
        return r < 1 && r > low && v / h > cut - 0.5;
      });
    case 2:
      return fill(x, y, [&](double u, double v) { return std::abs(u) < w && std::abs(v) < h; });
    case 3:  // A bar.
      return fill(x, y, [&](double u, double v) { return std::abs(u) < w && std::abs(v) < 0.06 * h; });
    case 4: {  // Two discs next to each other.
      const double gap = rng.Uniform(0.1, 0.4);
      fill(x, y, disc);
      return fill(x + gap * c, y + gap * s, disc);
    }
    default: {  // A row of dots, as of text.
      const int count = 3 + int(rng.Below(12));
      const double dot = rng.Uniform(0.004, 0.02), step = rng.Uniform(2.2, 4) * dot;
      for (int i = 0; i < count; ++i) {
        const double at_x = x + i * step * c, at_y = y + i * step * s, high = dot * rng.Uniform(0.5, 2);
        canvas.Fill(at_x - dot, at_y - high, at_x + dot, at_y + high, colour, [](double, double) { return true; });
      }
    }
  }
}

}  // namespace

void DrawClutter(std::span<float> picture, int size, Rng& rng) {
  DAUMIER_CHECK(picture.size() == 3 * size_t(size) * size_t(size), "a picture of side {} has {} numbers", size,
                picture.size());
  Canvas canvas(picture, size);
  DrawGround(canvas, rng);
  const uint64_t num_things = rng.Below(5) == 0 ? 0 : rng.Below(rng.Below(2) == 0 ? 8 : 40);
  for (uint64_t i = 0; i < num_things; ++i) DrawThing(canvas, rng);
}

void ShuffleBlocks(std::span<float> picture, int size, Rng& rng) {
  constexpr int kBlocks = 4;
  const int side = size / kBlocks;
  DAUMIER_CHECK(picture.size() == 3 * size_t(size) * size_t(size) && size % kBlocks == 0,
                "a picture of side {} has {} numbers", size, picture.size());
  const std::vector<float> from(picture.begin(), picture.end());
  const std::vector<int> order = rng.Permutation(kBlocks * kBlocks);
  const size_t count = size_t(size) * size_t(size);
  for (int block = 0; block < kBlocks * kBlocks; ++block) {
    const int source = order[size_t(block)];
    const bool turned = rng.Below(3) == 0;
    for (int row = 0; row < side; ++row)
      for (int column = 0; column < side; ++column) {
        const int to_row = block / kBlocks * side + row, to_column = block % kBlocks * side + column;
        const int from_row = source / kBlocks * side + (turned ? side - 1 - row : row),
                  from_column = source % kBlocks * side + column;
        for (size_t k = 0; k < 3; ++k)
          picture[k * count + size_t(to_row) * size_t(size) + size_t(to_column)] =
              from[k * count + size_t(from_row) * size_t(size) + size_t(from_column)];
      }
  }
}

}  // namespace daumier::portrait
