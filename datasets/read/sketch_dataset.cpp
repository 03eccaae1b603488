#include "datasets/read/sketch_dataset.h"

#include "core/error.h"
#include "core/parallel.h"

#include <algorithm>

namespace daumier::datasets {
namespace {

/// work(i) for i = 0..count-1, in one block a core.
template <class Work>
void OnAllCores(int64_t count, const Work& work) {
  const int num_cores = NumCores(), num_blocks = static_cast<int>(std::min<int64_t>(num_cores, count));
  const auto work_on = [&](int block) {
    const int64_t end = count * (block + 1) / num_blocks;
    for (int64_t i = count * block / num_blocks; i < end; ++i) work(i);
    return end;
  };
  ForEachInOrder(
      num_blocks, work_on, [](int64_t) {}, static_cast<unsigned>(num_cores));
}

}  // namespace

SketchDataset::SketchDataset(const SketchDatabase& sketches, std::vector<int> faces, int resolution,
                             const SketchVariation& variation, uint64_t seed)
    : faces_(std::move(faces)), resolution_(resolution), variation_(variation), seed_(seed), sketches_(sketches) {
  for (const int face : faces_) {
    DAUMIER_CHECK(face >= 0 && face < sketches.num_faces(), "sketch {} of a database of {}", face,
                  sketches.num_faces());
  }
  if (variation.varies(sketches)) return;
  ink_ = torch::empty({size(), 1, resolution, resolution}, torch::kUInt8);
  uint8_t* const ink = ink_.data_ptr<uint8_t>();
  OnAllCores(size(), [&](int64_t sample) {
    const render::Image image = Draw(faces_[sample], 0);
    std::transform(image.pixels.begin(), image.pixels.end(), ink + sample * int64_t(image.pixels.size()),
                   [](uint8_t grey) { return static_cast<uint8_t>(255 - grey); });
  });
}

SketchBatch SketchDataset::Get(std::span<const int> samples, int64_t epoch) const {
  const auto count = static_cast<int64_t>(samples.size());
  SketchBatch batch{torch::empty({count, 1, resolution_, resolution_}), torch::empty({count}, torch::kInt64)};
  const int64_t num_pixels = int64_t(resolution_) * resolution_;
  float* const images = batch.images.data_ptr<float>();
  int64_t* const faces = batch.faces.data_ptr<int64_t>();
  for (int64_t row = 0; row < count; ++row) {
    const int sample = samples[row];
    DAUMIER_CHECK(sample >= 0 && sample < size(), "sample {} of a dataset of {}", sample, size());
    faces[row] = faces_[sample];
    if (!ink_.defined()) continue;
    const uint8_t* const ink = ink_.data_ptr<uint8_t>() + sample * num_pixels;
    std::transform(ink, ink + num_pixels, images + row * num_pixels,
                   [](uint8_t value) { return static_cast<float>(value) / 255.0f; });
  }
  if (!ink_.defined()) {
    OnAllCores(count, [&](int64_t row) {
      const render::Image image = Draw(static_cast<int>(faces[row]), epoch);
      std::transform(image.pixels.begin(), image.pixels.end(), images + row * num_pixels,
                     [](uint8_t grey) { return static_cast<float>(255 - grey) / 255.0f; });
    });
  }
  return batch;
}

render::Image SketchDataset::Draw(int face, int64_t epoch) const {
  const AugmentedSketch sketch = VariedSketch(sketches_, face, variation_, seed_, epoch);
  return render::RasteriseStrokes(sketch.strokes, resolution_, sketch.style);
}

}  // namespace daumier::datasets
