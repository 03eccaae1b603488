#include "render/styles/plane_noise.h"

#include <algorithm>
#include <cmath>

namespace daumier::render {
namespace {

/// Cell and smoothstep weight of each pixel along one axis.
struct LatticeAxis {
  std::vector<int> cell;
  std::vector<float> weight;
  int num_cells = 0;

  LatticeAxis(int size, float cell_size, float shift) {
    const float cells_a_pixel = 1.0f / std::max(cell_size, 1.0f);
    for (int i = 0; i < size; ++i) {
      const float position = (static_cast<float>(i) + 0.5f) * cells_a_pixel + shift;
      const int from = static_cast<int>(position);
      const float t = position - static_cast<float>(from);
      cell.push_back(from);
      weight.push_back(t * t * (3 - 2 * t));
    }
    num_cells = size == 0 ? 0 : cell.back() + 2;
  }
};

}  // namespace

Plane SmoothNoise(int height, int width, float cell_x, float cell_y, Rng& rng) {
  const float shift_x = static_cast<float>(rng.Uniform()), shift_y = static_cast<float>(rng.Uniform());
  const LatticeAxis across(width, cell_x, shift_x), down(height, cell_y, shift_y);
  std::vector<float> lattice(size_t(across.num_cells) * down.num_cells);
  for (float& value : lattice) value = static_cast<float>(rng.Uniform(-1.0, 1.0));
  Plane noise(height, width);
  std::vector<float> line(across.num_cells);
  for (int row = 0; row < height; ++row) {
    const float* above = lattice.data() + size_t(down.cell[row]) * across.num_cells;
    const float* below = above + across.num_cells;
    const float v = down.weight[row];
    for (int i = 0; i < across.num_cells; ++i) line[i] = above[i] + v * (below[i] - above[i]);
    float* target = noise.row(row);
    for (int column = 0; column < width; ++column) {
      const float* left = line.data() + across.cell[column];
      target[column] = left[0] + across.weight[column] * (left[1] - left[0]);
    }
  }
  return noise;
}

Plane FractalNoise(int height, int width, float cell, int octaves, Rng& rng) {
  Plane sum(height, width);
  float strength = 1, total = 0;
  for (int octave = 0; octave < octaves; ++octave) {
    const Plane noise = SmoothNoise(height, width, cell, cell, rng);
    for (size_t i = 0; i < sum.values.size(); ++i) sum.values[i] += strength * noise.values[i];
    total += strength * strength;
    strength *= 0.55f;
    cell *= 0.5f;
  }
  const float share = 1.0f / std::sqrt(total);
  for (float& value : sum.values) value *= share;
  return sum;
}

Plane WhiteNoise(int height, int width, Rng& rng) {
  Plane noise(height, width);
  // Four bytes, uniform in 0..255, have the variance 4 (256^2 - 1) / 12.
  const float scale = 1.0f / std::sqrt(65535.0f / 3.0f);
  uint64_t bits = 0;
  for (size_t i = 0; i < noise.values.size(); ++i) {
    bits = i % 2 == 0 ? rng.Bits() : bits >> 32;
    const int sum = static_cast<int>((bits & 255) + (bits >> 8 & 255) + (bits >> 16 & 255) + (bits >> 24 & 255));
    noise.values[i] = static_cast<float>(sum - 510) * scale;
  }
  return noise;
}

Plane PaperGrain(int height, int width, Rng& rng) {
  Plane grain = BoxBlur(WhiteNoise(height, width, rng), 1);
  const Plane tooth = SmoothNoise(height, width, 2.2f, 2.2f, rng);
  for (size_t i = 0; i < grain.values.size(); ++i) {
    grain.values[i] = std::clamp(0.5f + 0.32f * grain.values[i] + 0.28f * tooth.values[i], 0.0f, 1.0f);
  }
  return grain;
}

}  // namespace daumier::render
