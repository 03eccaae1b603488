#include "render/styles/picture_layers.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>

namespace daumier::render {
namespace {

constexpr int kNumSoftened = 7;  ///< Albedo, normal and shade.

std::array<Plane*, kNumSoftened> SoftenedPlanes(PictureLayers& layers) {
  return {&layers.albedo[0], &layers.albedo[1], &layers.albedo[2], &layers.normal[0],
          &layers.normal[1], &layers.normal[2], &layers.shade};
}

/// Sums of the covered samples of each pixel, and what the nearest of them shows.
void SumSamples(const PictureBuffers& buffers, PictureLayers& layers) {
  const int factor = buffers.supersampling;
  float *red = layers.albedo[0].values.data(), *green = layers.albedo[1].values.data(),
        *blue = layers.albedo[2].values.data(), *x = layers.normal[0].values.data(),
        *y = layers.normal[1].values.data(), *z = layers.normal[2].values.data(), *shade = layers.shade.values.data(),
        *depth = layers.depth.values.data(), *coverage = layers.coverage.values.data();
  size_t from = 0;
  for (int row = 0; row < buffers.height; ++row) {
    const size_t first = size_t(row / factor) * layers.width;
    for (int column = 0; column < buffers.width; ++column, ++from) {
      if (!buffers.is_covered(from)) continue;
      const size_t to = first + column / factor;
      red[to] += buffers.albedo[3 * from];
      green[to] += buffers.albedo[3 * from + 1];
      blue[to] += buffers.albedo[3 * from + 2];
      x[to] += buffers.normal[3 * from];
      y[to] += buffers.normal[3 * from + 1];
      z[to] += buffers.normal[3 * from + 2];
      shade[to] += buffers.shade[from];
      coverage[to] += 1;
      if (buffers.depth[from] < depth[to]) {
        depth[to] = buffers.depth[from];
        layers.classes[to] = buffers.classes[from];
        layers.parts[to] = buffers.parts[from];
      }
    }
  }
}

bool IsAtBorder(const PictureLayers& layers, int row, int column) {
  const size_t here = size_t(row) * layers.width + column;
  const auto differs = [&](size_t there) {
    return layers.classes[here] != layers.classes[there] || layers.parts[here] != layers.parts[there] ||
           layers.coverage.values[here] != layers.coverage.values[there];
  };
  return (column > 0 && differs(here - 1)) || (column + 1 < layers.width && differs(here + 1)) ||
         (row > 0 && differs(here - layers.width)) || (row + 1 < layers.height && differs(here + layers.width));
}

void SoftenBorders(PictureLayers& layers) {
  const PictureLayers hard = layers;
  PictureLayers source = hard;  // SoftenedPlanes gives pointers to what may be changed.
  const auto from = SoftenedPlanes(source), to = SoftenedPlanes(layers);
  for (int row = 0; row < layers.height; ++row) {
    for (int column = 0; column < layers.width; ++column) {
      const size_t here = size_t(row) * layers.width + column;
      if (hard.coverage.values[here] == 0 || !IsAtBorder(hard, row, column)) continue;
      std::array<float, kNumSoftened> sums{};
      float covered = 0, total = 0;
      for (int i = -1; i <= 1; ++i) {
        for (int j = -1; j <= 1; ++j) {
          if (row + i < 0 || row + i >= layers.height || column + j < 0 || column + j >= layers.width) continue;
          const float weight = static_cast<float>((2 - std::abs(i)) * (2 - std::abs(j)));
          const size_t there = size_t(row + i) * layers.width + column + j;
          total += weight;
          if (hard.coverage.values[there] == 0) continue;
          covered += weight;
          for (int k = 0; k < kNumSoftened; ++k) sums[k] += weight * from[k]->values[there];
        }
      }
      for (int k = 0; k < kNumSoftened; ++k) to[k]->values[here] = sums[k] / covered;
      layers.coverage.values[here] = covered / total;
    }
  }
}

void CheckFinite(const PictureLayers& layers) {
  float sum = 0;
  for (size_t i = 0; i < layers.size(); ++i) {
    float pixel = layers.shade.values[i];
    for (int channel = 0; channel < 3; ++channel) {
      pixel += std::abs(layers.albedo[channel].values[i]) + std::abs(layers.normal[channel].values[i]);
    }
    sum += pixel * 0.0f;  // Anything else than 0 is not finite.
  }
  DAUMIER_CHECK(sum == 0, "a covered pixel's albedo, normal or shade is not finite");
}

}  // namespace

PictureLayers MakePictureLayers(const PictureBuffers& buffers) {
  CheckPictureBuffers(buffers);
  const int factor = buffers.supersampling, height = buffers.height / factor, width = buffers.width / factor;
  PictureLayers layers;
  layers.height = height;
  layers.width = width;
  layers.scale = static_cast<float>(height) / 224.0f;
  layers.pixels_per_cm = buffers.pixels_per_cm / static_cast<float>(factor);
  layers.albedo = layers.normal = MakeColourPlanes(height, width, {0, 0, 0});
  layers.shade = layers.coverage = Plane(height, width);
  layers.depth = Plane(height, width, PictureBuffers::kBackgroundDepth);
  layers.classes.assign(layers.size(), 0);
  layers.parts.assign(layers.size(), 0);
  SumSamples(buffers, layers);
  CheckFinite(layers);
  if (factor == 1) {
    SoftenBorders(layers);
    return layers;
  }
  const auto planes = SoftenedPlanes(layers);
  const float share = 1.0f / static_cast<float>(factor * factor);
  for (size_t i = 0; i < layers.size(); ++i) {
    const float covered = layers.coverage.values[i];
    if (covered == 0) continue;
    const float each = 1.0f / covered;
    for (Plane* plane : planes) plane->values[i] *= each;
    layers.coverage.values[i] = covered * share;
  }
  return layers;
}

}  // namespace daumier::render
