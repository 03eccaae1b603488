#include "systems/sketch/train/fits.h"

#include "datasets/read/curve_coefficients.h"
#include "eval/metrics.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace daumier::sketch {
namespace {

fitting::ProjectedCurves CurvesOf(const SketchRunData& data) {
  return fitting::SeeCurves(data.run.face_template, data.run.feature_curves, data.run.camera);
}

/// Neighbouring points of a curve are nearly redundant: every fourth, with weight 4.
std::vector<float> EveryFourth(std::vector<float> weights) {
  constexpr size_t kEvery = 4;
  for (size_t k = 0; k < weights.size(); ++k) weights[k] = k % kEvery == 0 ? kEvery * weights[k] : 0;
  return weights;
}

}  // namespace

MorphableRow::MorphableRow(const SketchRunData& data, const SketchReader& reader)
    : data_(data), reader_(reader), model_(fitting::ProjectModel(CurvesOf(data), data.run.models.bilinear)) {}

eval::FaceRows MorphableRow::Predict(std::span<const int> faces, const fitting::MorphableFitOptions& options) const {
  return eval::RowsOnAllCores(faces.size(), 3 * Eigen::Index(data_.faces.num_vertices()), [&](int i) {
    const datasets::AugmentedSketch sketch = reader_.SketchOf(faces[size_t(i)]);
    const auto fit = fitting::FitMorphable(
        model_, datasets::PointsOf(sketch.moved, data_.sketches.feature_curves()),
        EveryFourth(datasets::PointWeights(data_.sketches, sketch.moved, sketch.visible)), options);
    return faces::Reconstruct(data_.run.models.bilinear, fit.u, fit.v);
  });
}

fitting::MorphableFitOptions MorphableRow::ChooseOptions(std::span<const int> validation, std::span<const int> region,
                                                         size_t most_faces) const {
  const size_t step = std::max<size_t>(1, validation.size() / most_faces);
  std::vector<int> faces;
  for (size_t i = 0; i < validation.size(); i += step) faces.push_back(validation[i]);
  fitting::MorphableFitOptions best;
  double least = std::numeric_limits<double>::infinity();
  for (const double deviation_px : {0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0}) {
    const fitting::MorphableFitOptions options{.prior = true, .deviation_px = deviation_px};
    const eval::FaceRows fitted = Predict(faces, options);
    double error = 0;
    for (size_t i = 0; i < faces.size(); ++i) {
      const auto row = fitted.row(Eigen::Index(i));
      error += eval::MeanVertexError({row.data(), size_t(row.size())}, data_.faces.vertices(faces[i]), region, 1);
    }
    if (error < least) least = error, best = options;
  }
  return best;
}

RefinedRow::RefinedRow(const SketchRunData& data, const SketchReader& reader)
    : reader_(reader), refiner_(data.run.models.bilinear, CurvesOf(data)) {}

eval::FaceRows RefinedRow::Refine(std::span<const int> faces, const SketchPredictions& predicted) const {
  return eval::RowsOnAllCores(faces.size(), predicted.faces.cols(), [&](int i) {
    const std::span<const float> face = eval::RowSpan(predicted.faces, size_t(i));
    return refiner_
        .Refine({predicted.u.row(i), predicted.v.row(i), {face.begin(), face.end()}},
                reader_.SketchOf(faces[size_t(i)]).strokes)
        .vertices;
  });
}

FittedRow::FittedRow(const SketchRunData& data, const SketchReader& reader, std::shared_ptr<const DrawingParser> parser)
    : reader_(reader), fitter_(data.run, std::move(parser)) {}

eval::FaceRows FittedRow::Fit(std::span<const int> faces, const eval::FaceRows& start) const {
  return eval::RowsOnAllCores(faces.size(), start.cols(), [&](int i) {
    return fitter_.FittedTo(reader_.SketchOf(faces[size_t(i)]).strokes, eval::RowSpan(start, size_t(i))).vertices;
  });
}

}  // namespace daumier::sketch
