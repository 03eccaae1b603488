#include "systems/portrait/landmark_augmentation.h"

#include "core/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace daumier::portrait {
namespace {

/// The three channels of a picture.
struct Channels {
  std::array<float*, 3> of;
  int size;
  size_t count() const { return size_t(size) * size_t(size); }
};

float Unit(float value) {
  return std::clamp(value, 0.0f, 1.0f);
}

template <class Change>
void ForEachValue(const Channels& picture, const Change& change) {
  for (float* channel : picture.of)
    for (size_t i = 0; i < picture.count(); ++i) channel[i] = Unit(change(channel[i]));
}

/// Gains of the channels, or mixtures of them.
void ChangeHues(const Channels& picture, double gain, bool mixes, double strength, Rng& rng) {
  std::array<std::array<float, 3>, 3> matrix = {};
  for (size_t k = 0; k < 3; ++k) matrix[k][k] = float(std::exp(rng.Uniform(-gain, gain)));
  if (mixes) {
    for (auto& row : matrix) {
      for (float& entry : row) entry += float(rng.Uniform(-0.35, 0.35) * strength);
    }
  }
  const float offset = float(rng.Uniform(-0.12, 0.12) * strength);
  for (size_t i = 0; i < picture.count(); ++i) {
    const std::array<float, 3> from = {picture.of[0][i], picture.of[1][i], picture.of[2][i]};
    for (size_t k = 0; k < 3; ++k)
      picture.of[k][i] = Unit(matrix[k][0] * from[0] + matrix[k][1] * from[1] + matrix[k][2] * from[2] + offset);
  }
}

std::vector<float> GreyOf(const Channels& picture) {
  std::vector<float> grey(picture.count());
  for (size_t i = 0; i < grey.size(); ++i)
    grey[i] = 0.299f * picture.of[0][i] + 0.587f * picture.of[1][i] + 0.114f * picture.of[2][i];
  return grey;
}

void SetGrey(const Channels& picture, const std::vector<float>& grey) {
  for (float* channel : picture.of) std::copy(grey.begin(), grey.end(), channel);
}

/// The mean of (2 reach + 1)^2 neighbours, the border continued, by running sums along both axes.
void BlurChannel(float* channel, int size, int reach) {
  std::vector<float> line(static_cast<size_t>(size));
  const float share = 1.0f / float(2 * reach + 1);
  const auto blur_line = [&](float* first, int step) {
    for (int i = 0; i < size; ++i) line[size_t(i)] = first[i * step];
    float sum = 0;
    for (int i = -reach; i <= reach; ++i) sum += line[size_t(std::clamp(i, 0, size - 1))];
    for (int i = 0; i < size; ++i) {
      first[i * step] = Unit(sum * share);
      sum += line[size_t(std::min(i + reach + 1, size - 1))] - line[size_t(std::max(i - reach, 0))];
    }
  };
  for (int i = 0; i < size; ++i) blur_line(channel + size_t(i) * size_t(size), 1);
  for (int i = 0; i < size; ++i) blur_line(channel + i, size);
}

/// Blocks of `side` pixels become their mean, then are enlarged bilinearly.
void MakeCoarse(float* channel, int size, int side) {
  const int cells = size / side;
  std::vector<float> means(size_t(cells) * size_t(cells), 0);
  for (int row = 0; row < cells * side; ++row)
    for (int column = 0; column < cells * side; ++column)
      means[size_t(row / side) * size_t(cells) + size_t(column / side)] +=
          channel[size_t(row) * size_t(size) + size_t(column)] / float(side * side);
  for (int row = 0; row < size; ++row) {
    const float y = std::clamp((float(row) + 0.5f) / float(side) - 0.5f, 0.0f, float(cells - 1));
    const int r0 = int(y), r1 = std::min(r0 + 1, cells - 1);
    for (int column = 0; column < size; ++column) {
      const float x = std::clamp((float(column) + 0.5f) / float(side) - 0.5f, 0.0f, float(cells - 1));
      const int c0 = int(x), c1 = std::min(c0 + 1, cells - 1);
      const float u = x - float(c0), v = y - float(r0);
      const auto at = [&](int r, int c) { return means[size_t(r) * size_t(cells) + size_t(c)]; };
      channel[size_t(row) * size_t(size) + size_t(column)] =
          Unit((1 - v) * ((1 - u) * at(r0, c0) + u * at(r0, c1)) + v * ((1 - u) * at(r1, c0) + u * at(r1, c1)));
    }
  }
}

using Block = std::array<std::array<float, 8>, 8>;

/// cosines[u][x] of the orthonormal transform of 8 values.
const Block& Cosines() {
  static const Block cosines = [] {
    Block values;
    for (int u = 0; u < 8; ++u)
      for (int x = 0; x < 8; ++x)
        values[size_t(u)][size_t(x)] =
            float(std::sqrt(u == 0 ? 0.125 : 0.25) * std::cos((2 * x + 1) * u * std::numbers::pi / 16));
    return values;
  }();
  return cosines;
}

/// Rounds the frequencies of 8 x 8 blocks as JPEG does [ITU T.81], with one step that grows with the frequency in place of
/// its tables.
void RoundFrequencies(float* channel, int size, float step) {
  const Block& cosines = Cosines();
  for (int top = 0; top + 8 <= size; top += 8)
    for (int left = 0; left + 8 <= size; left += 8) {
      Block values, half = {}, frequencies = {};
      for (size_t y = 0; y < 8; ++y)
        for (size_t x = 0; x < 8; ++x) values[y][x] = channel[(size_t(top) + y) * size_t(size) + size_t(left) + x];
      for (size_t y = 0; y < 8; ++y)
        for (size_t u = 0; u < 8; ++u)
          for (size_t x = 0; x < 8; ++x) half[y][u] += values[y][x] * cosines[u][x];
      for (size_t v = 0; v < 8; ++v)
        for (size_t u = 0; u < 8; ++u) {
          float sum = 0;
          for (size_t y = 0; y < 8; ++y) sum += half[y][u] * cosines[v][y];
          const float of_step = step * (1 + 0.5f * float(u + v));
          frequencies[v][u] = of_step * std::round(sum / of_step);
        }
      half = {};
      for (size_t v = 0; v < 8; ++v)
        for (size_t x = 0; x < 8; ++x)
          for (size_t u = 0; u < 8; ++u) half[v][x] += frequencies[v][u] * cosines[u][x];
      for (size_t y = 0; y < 8; ++y)
        for (size_t x = 0; x < 8; ++x) {
          float sum = 0;
          for (size_t v = 0; v < 8; ++v) sum += half[v][x] * cosines[v][y];
          channel[(size_t(top) + y) * size_t(size) + size_t(left) + x] = Unit(sum);
        }
    }
}

/// Dark lines where the picture is darker than around, on light paper.
void DrawLinesOf(const Channels& picture, Rng& rng) {
  std::vector<float> fine = GreyOf(picture), wide = fine;
  BlurChannel(wide.data(), picture.size, 1 + int(rng.Below(4)));
  const float gain = float(rng.Uniform(4, 14)), paper = float(rng.Uniform(0.75, 1)), tone = float(rng.Uniform(0, 0.3));
  for (size_t i = 0; i < fine.size(); ++i) {
    const float line = std::max(0.0f, wide[i] - fine[i]) * gain;
    fine[i] = Unit(paper * (1 - tone * (1 - wide[i])) - line);
  }
  SetGrey(picture, fine);
}

void AddNoise(const Channels& picture, float deviation, Rng& rng) {
  // Sums of two uniform numbers from one draw: triangular, of the deviation wanted.
  const float factor = deviation * std::sqrt(6.0f) / 65536.0f;
  const bool is_grey = rng.Below(2) == 0;
  for (size_t i = 0; i < picture.count(); ++i) {
    uint64_t bits = rng.Bits();
    for (size_t k = 0; k < 3; ++k) {
      const float noise = float(bits & 0xffff) - float((bits >> 16) & 0xffff);
      picture.of[k][i] = Unit(picture.of[k][i] + factor * noise);
      if (!is_grey) bits = (bits >> 13) ^ (bits << 27);
    }
  }
}

/// A rectangle or ellipse that may be turned.
struct Patch {
  double x, y, half_width, half_height, turn;
  bool is_round;

  bool Covers(double px, double py) const {
    const double dx = px - x, dy = py - y, c = std::cos(turn), s = std::sin(turn);
    const double u = (c * dx + s * dy) / half_width, v = (c * dy - s * dx) / half_height;
    return is_round ? u * u + v * v < 1 : std::abs(u) < 1 && std::abs(v) < 1;
  }
};

Patch DrawPatch(int size, Rng& rng) {
  const bool is_bar = rng.Below(4) == 0;
  Patch patch{.x = rng.Uniform(0.1, 0.9) * size,
              .y = rng.Uniform(0.1, 0.9) * size,
              .half_width = rng.Uniform(0.03, is_bar ? 0.5 : 0.16) * size,
              .half_height = rng.Uniform(0.02, is_bar ? 0.03 : 0.16) * size,
              .turn = rng.Uniform(0, std::numbers::pi),
              .is_round = rng.Below(2) == 0};
  return patch;
}

}  // namespace

void ChangeColours(std::span<float> values, int size, const LandmarkAugmentationOptions& options, Rng& rng) {
  const size_t count = size_t(size) * size_t(size);
  DAUMIER_CHECK(values.size() == 3 * count, "a picture of side {} has {} numbers", size, values.size());
  const double strength = options.strength;
  if (strength == 0) return;
  const Channels picture{{values.data(), values.data() + count, values.data() + 2 * count}, size};
  const auto happens = [&](double share) { return rng.Uniform() < share * strength; };
  if (happens(options.line_drawing)) DrawLinesOf(picture, rng);
  ChangeHues(picture, options.colour * strength, happens(options.tint), strength, rng);
  if (happens(options.grey)) SetGrey(picture, GreyOf(picture));
  if (happens(0.5)) {
    const auto exponent = float(std::exp(rng.Uniform(-options.contrast, options.contrast) * strength));
    ForEachValue(picture, [&](float value) { return std::pow(value, exponent); });
  }
  if (happens(options.invert)) ForEachValue(picture, [](float value) { return 1 - value; });
  if (happens(options.posterise)) {
    const auto levels = float(3 + rng.Below(6));
    ForEachValue(picture, [&](float value) { return std::round(value * levels) / levels; });
  }
  if (happens(options.blur))
    for (float* channel : picture.of) BlurChannel(channel, size, 1);
  if (happens(options.coarse)) {
    const int side = 2 + int(rng.Below(3));
    for (float* channel : picture.of) MakeCoarse(channel, size, side);
  }
  if (happens(options.noise)) AddNoise(picture, float(rng.Uniform(0.005, 0.07) * strength), rng);
  if (happens(options.jpeg)) {
    const auto step = float(rng.Uniform(0.05, 0.25));
    for (float* channel : picture.of) RoundFrequencies(channel, size, step);
  }
}

void PaintTeeth(std::span<float> picture, int size, std::span<const uint8_t> is_mouth, int cells, Rng& rng) {
  const size_t count = size_t(size) * size_t(size);
  DAUMIER_CHECK(picture.size() == 3 * count && is_mouth.size() == size_t(cells) * size_t(cells),
                "a picture of side {} has {} numbers, and {} marks are no {} x {}", size, picture.size(),
                is_mouth.size(), cells, cells);
  if (std::ranges::count(is_mouth, 1) < 10) return;
  const std::array<float, 3> white = {float(rng.Uniform(0.75, 1)), float(rng.Uniform(0.75, 1)),
                                      float(rng.Uniform(0.6, 1))};
  const double upper = rng.Uniform(0.3, 1.1), lower = rng.Below(2) == 0 ? rng.Uniform(0.6, 1) : 2;
  const double tooth = rng.Uniform(0.02, 0.06) * size, phase = rng.Uniform(0, tooth), gap = rng.Uniform(0, 0.25);
  const auto darkness = float(rng.Uniform(0.2, 0.8));
  for (int column = 0; column < size; ++column) {
    const auto marked = [&](int row) {
      return is_mouth[size_t(row * cells / size) * size_t(cells) + size_t(column * cells / size)] != 0;
    };
    int first = 0, last = size - 1;
    while (first < size && !marked(first)) ++first;
    while (last > first && !marked(last)) --last;
    const double height = last - first + 1, in_tooth = std::fmod(column + phase, tooth) / tooth;
    for (int row = first; row <= last && row < size; ++row) {
      const double depth = (row - first + 0.5) / height;
      if (!marked(row) || (depth > upper && depth < lower)) continue;
      const float share = in_tooth < gap ? darkness : 1.0f;
      for (size_t k = 0; k < 3; ++k)
        picture[k * count + size_t(row) * size_t(size) + size_t(column)] = share * white[k];
    }
  }
}

void DrawOccluders(std::span<float> picture, int size, std::span<uint8_t> covered, int cells, Rng& rng) {
  const size_t count = size_t(size) * size_t(size);
  DAUMIER_CHECK(picture.size() == 3 * count && covered.size() == size_t(cells) * size_t(cells),
                "a picture of side {} has {} numbers, and {} covers are no {} x {}", size, picture.size(),
                covered.size(), cells, cells);
  const int num_patches = 1 + int(rng.Below(4));
  for (int i = 0; i < num_patches; ++i) {
    const Patch patch = DrawPatch(size, rng);
    const std::array<float, 3> colour = {float(rng.Uniform()), float(rng.Uniform()), float(rng.Uniform())};
    const float grain = rng.Below(2) == 0 ? float(rng.Uniform(0, 0.4)) : 0.0f;
    for (int row = 0; row < size; ++row)
      for (int column = 0; column < size; ++column) {
        if (!patch.Covers(column + 0.5, row + 0.5)) continue;
        const float shade = grain > 0 ? grain * float(rng.Uniform() - 0.5) : 0.0f;
        for (size_t k = 0; k < 3; ++k)
          picture[k * count + size_t(row) * size_t(size) + size_t(column)] = Unit(colour[k] + shade);
      }
    const double cell = double(size) / cells;
    for (int row = 0; row < cells; ++row)
      for (int column = 0; column < cells; ++column)
        if (patch.Covers((column + 0.5) * cell, (row + 0.5) * cell))
          covered[size_t(row) * size_t(cells) + size_t(column)] = 1;
  }
}

}  // namespace daumier::portrait
