#include "datasets/read/sketch_dataset.h"

#include "core/error.h"
#include "core/parallel.h"
#include "datasets/read/curve_coefficients.h"
#include "render/stroke_samples.h"

#include <algorithm>

namespace daumier::datasets {
namespace {

/// Entries `chosen` of the first dimension; undefined if `all` is.
template <class T>
Array<T> RowsOf(const Array<T>& all, std::span<const int> chosen) {
  if (!all.defined()) return {};
  std::vector<int64_t> shape = all.shape;
  shape[0] = static_cast<int64_t>(chosen.size());
  Array<T> rows(shape);
  for (size_t i = 0; i < chosen.size(); ++i)
    std::copy_n(all.row(chosen[i]), all.row_size(), rows.row(static_cast<int64_t>(i)));
  return rows;
}

void WriteInk(const render::Image& image, uint8_t* ink) {
  std::transform(image.pixels.begin(), image.pixels.end(), ink,
                 [](uint8_t grey) { return static_cast<uint8_t>(255 - grey); });
}

}  // namespace

SketchDataset::SketchDataset(const SketchDatabase& sketches, std::vector<int> faces, const SketchReading& reading,
                             const SketchVariation& variation, uint64_t seed)
    : faces_(std::move(faces)),
      reading_(reading),
      variation_(variation),
      seed_(seed),
      sketches_(sketches),
      varies_(!reading.fixed && variation.varies(sketches)) {
  for (const int face : faces_) {
    DAUMIER_CHECK(face >= 0 && face < sketches.num_faces(), "sketch {} of a database of {}", face,
                  sketches.num_faces());
  }
  if (varies_ || faces_.empty()) return;
  kept_ = EmptyRows(size());
  OnAllCores(size(), [&](int64_t sample) { Read(faces_[size_t(sample)], 0, sample, kept_); });
}

SketchDataset::Rows SketchDataset::EmptyRows(int64_t count) const {
  Rows rows;
  if (reading_.resolution > 0) rows.ink = Array<uint8_t>({count, 1, reading_.resolution, reading_.resolution});
  if (reading_.num_points > 0) rows.points = FloatArray({count, 4, reading_.num_points});
  if (reading_.encoder) rows.shape = FloatArray({count, reading_.encoder->num_numbers()});
  return rows;
}

void SketchDataset::Read(int face, int64_t epoch, int64_t row, Rows& rows) const {
  const AugmentedSketch sketch = VariedSketch(sketches_, face, variation_, seed_, epoch);
  if (rows.ink.defined())
    WriteInk(render::RasteriseStrokes(sketch.strokes, reading_.resolution, sketch.style), rows.ink.row(row));
  if (rows.points.defined())
    std::ranges::copy(render::SampleRows(sketch.strokes, reading_.num_points), rows.points.row(row));
  if (rows.shape.defined()) {
    const Eigen::VectorXf numbers = GivenShape(*reading_.encoder, sketches_, sketch.moved, sketch.visible).numbers();
    std::copy(numbers.begin(), numbers.end(), rows.shape.row(row));
  }
}

SampleBatch SketchDataset::Get(std::span<const int> samples, int64_t epoch) const {
  const auto count = static_cast<int64_t>(samples.size());
  SampleBatch batch{.samples = {samples.begin(), samples.end()}, .arrays = {}, .indices = {}};
  Array<int64_t> faces({count});
  for (int64_t row = 0; row < count; ++row) {
    const int sample = samples[size_t(row)];
    DAUMIER_CHECK(sample >= 0 && sample < size(), "sample {} of a dataset of {}", sample, size());
    faces.values[size_t(row)] = faces_[size_t(sample)];
  }
  Rows rows;
  if (varies_) {
    rows = EmptyRows(count);
    OnAllCores(count, [&](int64_t row) { Read(static_cast<int>(faces.values[size_t(row)]), epoch, row, rows); });
  } else {
    rows = {RowsOf(kept_.ink, samples), RowsOf(kept_.points, samples), RowsOf(kept_.shape, samples)};
  }
  if (rows.ink.defined()) {
    FloatArray images(rows.ink.shape);
    std::ranges::transform(rows.ink.values, images.values.begin(), [](uint8_t ink) { return float(ink) / 255.0f; });
    batch.arrays["images"] = std::move(images);
  }
  if (rows.points.defined()) batch.arrays["points"] = std::move(rows.points);
  if (rows.shape.defined()) batch.arrays["shape"] = std::move(rows.shape);
  batch.indices["faces"] = std::move(faces);
  return batch;
}

}  // namespace daumier::datasets
