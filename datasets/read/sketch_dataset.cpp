#include "datasets/read/sketch_dataset.h"

#include "core/error.h"
#include "core/parallel.h"
#include "datasets/read/shape_numbers.h"
#include "render/stroke_samples.h"
#include "tensor/torch_version.h"

#include <algorithm>

namespace daumier::datasets {
namespace {

/// The row's first element.
template <class T>
T* RowOf(const torch::Tensor& tensor, int64_t row) {
  return tensor.data_ptr<T>() + row * (tensor.numel() / tensor.size(0));
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
  if (reading_.resolution > 0)
    rows.ink = torch::empty({count, 1, reading_.resolution, reading_.resolution}, torch::kUInt8);
  if (reading_.num_points > 0) rows.points = torch::empty({count, 4, reading_.num_points});
  if (reading_.encoder) rows.shape = torch::empty({count, reading_.encoder->num_numbers()});
  return rows;
}

void SketchDataset::Read(int face, int64_t epoch, int64_t row, const Rows& rows) const {
  const AugmentedSketch sketch = VariedSketch(sketches_, face, variation_, seed_, epoch);
  if (rows.ink.defined())
    WriteInk(render::RasteriseStrokes(sketch.strokes, reading_.resolution, sketch.style),
             RowOf<uint8_t>(rows.ink, row));
  if (rows.points.defined())
    std::ranges::copy(render::SampleRows(sketch.strokes, reading_.num_points), RowOf<float>(rows.points, row));
  if (rows.shape.defined()) {
    const Eigen::VectorXf numbers = GivenShape(*reading_.encoder, sketches_, sketch.moved, sketch.visible).numbers();
    std::copy(numbers.begin(), numbers.end(), RowOf<float>(rows.shape, row));
  }
}

SketchBatch SketchDataset::Get(std::span<const int> samples, int64_t epoch) const {
  const auto count = static_cast<int64_t>(samples.size());
  SketchBatch batch;
  batch.faces = torch::empty({count}, torch::kInt64);
  int64_t* const faces = batch.faces.data_ptr<int64_t>();
  for (int64_t row = 0; row < count; ++row) {
    const int sample = samples[size_t(row)];
    DAUMIER_CHECK(sample >= 0 && sample < size(), "sample {} of a dataset of {}", sample, size());
    faces[row] = faces_[size_t(sample)];
  }
  Rows rows;
  if (varies_) {
    rows = EmptyRows(count);
    OnAllCores(count, [&](int64_t row) { Read(static_cast<int>(faces[row]), epoch, row, rows); });
  } else {
    const torch::Tensor index = torch::tensor(std::vector<int>(samples.begin(), samples.end()), torch::kInt64);
    const auto chosen = [&](const torch::Tensor& all) {
      return all.defined() ? all.index_select(0, index) : torch::Tensor();
    };
    rows = {chosen(kept_.ink), chosen(kept_.points), chosen(kept_.shape)};
  }
  if (rows.ink.defined()) {
    const auto layout = torch::dtype(torch::kFloat32).memory_format(torch::MemoryFormat::ChannelsLast);
    batch.images = torch::empty(rows.ink.sizes(), layout).copy_(rows.ink).div_(255);
  }
  batch.points = rows.points;
  batch.shape = rows.shape;
  return batch;
}

}  // namespace daumier::datasets
