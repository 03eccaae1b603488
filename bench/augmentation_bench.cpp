// What an augmented training sample costs: the augmentation of 25 strokes of 16 points beside drawing them at 128 x
// 128.
#include "core/random.h"
#include "datasets/read/augmentation.h"

#include <benchmark/benchmark.h>

#include <cmath>

namespace {

using daumier::datasets::AugmentationOptions;

constexpr int kStrokes = 25, kPoints = 16, kSize = 128;

/// Arcs of 20 to 120 pixels, as lines of a face.
std::vector<daumier::render::Stroke> Strokes() {
  std::vector<daumier::render::Stroke> strokes(kStrokes);
  for (int s = 0; s < kStrokes; ++s) {
    for (int p = 0; p < kPoints; ++p) {
      const double angle = 0.12 * p + s;
      strokes[s].points.push_back({static_cast<float>(128 + (11 + 2 * s) * std::cos(angle)),
                                   static_cast<float>(128 + (11 + 3 * s) * std::sin(angle))});
    }
  }
  return strokes;
}

AugmentationOptions Options() {
  AugmentationOptions options;
  options.strength = 1;
  return options;
}

void Augmentation(benchmark::State& state) {
  const auto strokes = Strokes();
  daumier::Rng rng(1);
  for (auto _ : state) benchmark::DoNotOptimize(daumier::datasets::Augment(strokes, Options(), rng).strokes.data());
}
BENCHMARK(Augmentation)->Unit(benchmark::kMicrosecond);

void Rasterisation(benchmark::State& state) {
  daumier::Rng rng(1);
  const auto sketch = daumier::datasets::Augment(Strokes(), Options(), rng);
  for (auto _ : state) {
    benchmark::DoNotOptimize(daumier::render::RasteriseStrokes(sketch.strokes, kSize, sketch.style).pixels.data());
  }
}
BENCHMARK(Rasterisation)->Unit(benchmark::kMicrosecond);

}  // namespace
