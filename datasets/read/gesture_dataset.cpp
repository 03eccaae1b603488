#include "datasets/read/gesture_dataset.h"

#include "core/error.h"
#include "core/parallel.h"

namespace daumier::datasets {

GestureDataset::GestureDataset(const GestureDatabase& database, std::vector<int> strokes, const GestureRaster& raster)
    : database_(database), strokes_(std::move(strokes)), raster_(raster) {
  for (const int stroke : strokes_)
    DAUMIER_CHECK(stroke >= 0 && stroke < database.num_strokes(), "stroke {} of a database of {}", stroke,
                  database.num_strokes());
}

SampleBatch GestureDataset::Get(std::span<const int> samples) const {
  for (const int sample : samples)
    DAUMIER_CHECK(sample >= 0 && sample < size(), "sample {} of a dataset of {}", sample, size());
  const auto count = int64_t(samples.size());
  FloatArray pictures({count, 1, raster_.side, raster_.side});
  Array<int64_t> gestures({count});
  OnAllCores(count, [&](int64_t row) {
    const LabelledStroke stroke = database_.stroke(strokes_[size_t(samples[size_t(row)])]);
    RasteriseGesture(stroke.points, raster_, {pictures.row(row), size_t(pictures.row_size())});
    gestures.values[size_t(row)] = int64_t(stroke.gesture);
  });
  SampleBatch batch{.samples = {samples.begin(), samples.end()}, .arrays = {}, .indices = {}};
  batch.arrays.emplace("pictures", std::move(pictures));
  batch.indices.emplace("gestures", std::move(gestures));
  return batch;
}

}  // namespace daumier::datasets
