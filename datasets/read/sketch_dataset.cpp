#include "datasets/read/sketch_dataset.h"

#include "core/error.h"
#include "core/parallel.h"

#include <algorithm>

namespace daumier::datasets {

SketchDataset::SketchDataset(const SketchDatabase& sketches, std::vector<int> faces, int resolution)
    : faces_(std::move(faces)), ink_(torch::empty({size(), 1, resolution, resolution}, torch::kUInt8)) {
  const int64_t num_pixels = int64_t(resolution) * resolution;
  uint8_t* const ink = ink_.data_ptr<uint8_t>();
  constexpr int kBlock = 64;
  const auto draw = [&](int block) {
    const int end = std::min(size(), (block + 1) * kBlock);
    for (int sample = block * kBlock; sample < end; ++sample) {
      const render::Image image = render::RasteriseStrokes(sketches.strokes(faces_[sample]), resolution);
      std::transform(image.pixels.begin(), image.pixels.end(), ink + sample * num_pixels,
                     [](uint8_t grey) { return static_cast<uint8_t>(255 - grey); });
    }
    return end;
  };
  ForEachInOrder((size() + kBlock - 1) / kBlock, draw, [](int) {});
}

SketchBatch SketchDataset::Get(std::span<const int> samples) const {
  const auto count = static_cast<int64_t>(samples.size());
  SketchBatch batch{torch::empty({count, 1, ink_.size(2), ink_.size(3)}), torch::empty({count}, torch::kInt64)};
  const int64_t num_pixels = ink_.size(2) * ink_.size(3);
  const uint8_t* const ink = ink_.data_ptr<uint8_t>();
  float* const images = batch.images.data_ptr<float>();
  int64_t* const faces = batch.faces.data_ptr<int64_t>();
  for (int64_t row = 0; row < count; ++row) {
    const int sample = samples[row];
    DAUMIER_CHECK(sample >= 0 && sample < size(), "sample {} of a dataset of {}", sample, size());
    std::transform(ink + sample * num_pixels, ink + (sample + 1) * num_pixels, images + row * num_pixels,
                   [](uint8_t value) { return static_cast<float>(value) / 255.0f; });
    faces[row] = faces_[sample];
  }
  return batch;
}

}  // namespace daumier::datasets
