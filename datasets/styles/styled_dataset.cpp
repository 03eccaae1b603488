#include "datasets/styles/styled_dataset.h"

#include "core/error.h"
#include "core/parallel.h"

#include <algorithm>

namespace daumier::datasets {
namespace {

uint64_t StreamIndex(int sample, int64_t epoch) {
  return static_cast<uint64_t>(epoch) << 32 | static_cast<uint32_t>(sample);
}

template <class T>
int64_t ClassOf(const ShownWith<T>& state) {
  return state.is_shown() ? static_cast<int64_t>(state.value) : kUnknownClass;
}

}  // namespace

StyledDataset::StyledDataset(std::vector<StyledSource> sources, const StyledReading& reading, uint64_t seed,
                             const StyledSides& sides)
    : sources_(std::move(sources)), reading_(reading), sides_(sides), seed_(seed) {
  for (const StyledSource& source : sources_) {
    if (!source.faces.empty()) (void)source.sketches.facts(source.faces.front());
    for (const int face : source.faces) {
      DAUMIER_CHECK(face >= 0 && face < source.sketches.num_faces(), "sketch {} of a database of {}", face,
                    source.sketches.num_faces());
    }
    first_.push_back(first_.back() + static_cast<int>(source.faces.size()));
  }
}

StyledDataset::Origin StyledDataset::origin(int sample) const {
  DAUMIER_CHECK(sample >= 0 && sample < size(), "sample {} of a dataset of {}", sample, size());
  const auto source = std::upper_bound(first_.begin(), first_.end(), sample) - first_.begin() - 1;
  return {static_cast<int>(source), sources_[size_t(source)].faces[size_t(sample - first_[size_t(source)])]};
}

StyledDrawing StyledDataset::Drawing(int sample, int64_t epoch) const {
  const auto [source, face] = origin(sample);
  const SketchDatabase& sketches = sources_[size_t(source)].sketches;
  Rng rng = Stream(seed_, "styled drawing", StreamIndex(sample, epoch));
  const bool is_turned = sketches.num_turned_views() > 0 && rng.Uniform() < reading_.turned;
  const int num_views = is_turned ? sketches.num_turned_views() : sketches.num_views();
  const int view = (is_turned ? sketches.num_views() : 0) + static_cast<int>(rng.Below(uint64_t(num_views)));
  StyledDrawing drawing = DrawInStyle(ShapeOf(sketches, face, view), reading_.styles, rng);
  return rng.Uniform() < reading_.mirrored ? Mirrored(std::move(drawing)) : drawing;
}

SampleBatch StyledDataset::Get(std::span<const int> samples, int64_t epoch) const {
  const auto count = static_cast<int64_t>(samples.size());
  const int r = sides_.picture, l = sides_.labels;
  FloatArray pictures({count, 1, r, r}), points({count, faces::kNumFacePoints, 2}),
      weights({count, faces::kNumFacePoints});
  Array<int64_t> labels({count, l, l}), states({count, int64_t(kDrawingStateNames.size())});
  OnAllCores(count, [&](int64_t row) {
    const int sample = samples[size_t(row)];
    const StyledDrawing drawing = Drawing(sample, epoch);
    Rng rng = Stream(seed_, "styled pen", StreamIndex(sample, epoch));
    const PenView pen = rng.Uniform() < reading_.as_drawn ? PenView::kAsDrawn : PenView::kTraced;
    const render::Image image = RasteriseDrawing(drawing, r, pen, reading_.traced_width);
    std::ranges::transform(image.pixels, pictures.row(row), [](uint8_t grey) { return float(255 - grey) / 255.0f; });
    const float cells = float(sides_.map) / render::kSketchCanvas;
    for (size_t i = 0; i < drawing.points.size(); ++i) {
      const auto& point = drawing.points[i];
      if (!point.is_shown()) continue;
      points.row(row)[2 * i] = cells * point.value[0];
      points.row(row)[2 * i + 1] = cells * point.value[1];
      weights.row(row)[i] = 1;
    }
    std::ranges::transform(RasteriseLabels(drawing, l), labels.row(row), [](int8_t label) {
      return label == kNoLineLabel ? kUnknownClass : static_cast<int64_t>(label);
    });
    int64_t* state = states.row(row);
    state[0] = ClassOf(drawing.mouth);
    state[1] = ClassOf(drawing.eyes[0]);
    state[2] = ClassOf(drawing.eyes[1]);
    state[3] = ClassOf(drawing.view);
  });
  SampleBatch batch;
  batch.samples.assign(samples.begin(), samples.end());
  batch.arrays = {{"pictures", std::move(pictures)}, {"points", std::move(points)}, {"weights", std::move(weights)}};
  batch.indices = {{"labels", std::move(labels)}, {"states", std::move(states)}};
  return batch;
}

}  // namespace daumier::datasets
