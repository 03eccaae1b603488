#include "eval/sketch_comparison.h"

#include "core/error.h"
#include "datasets/read/sketch_dataset.h"
#include "eval/comparison_sheet.h"
#include "eval/metrics.h"
#include "faces/face_database.h"
#include "models/sketch_run.h"
#include "render/strokes.h"
#include "tensor/eigen.h"
#include "tensor/torch_version.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace daumier::eval {
namespace {

/// The databases that all runs share.
class Comparison {
 public:
  explicit Comparison(const models::SketchRun& first)
      : data_(first.manifest.details.at("data")),
        faces_(first.config.at("data").at("faces").get<std::string>()),
        sketches_(first.config.at("data").at("sketches").get<std::string>()) {}

  const faces::FaceTemplate& face_template() const { return faces_.face_template(); }

  /// The row of a face, with its sketch as that run sees it, without predictions.
  ComparedFace Row(const ComparedSketch& shown, const models::SketchRun& run, double strength) const {
    const datasets::SketchVariation variation = VariationOf(run, strength);
    const auto seen = datasets::VariedSketch(sketches_, shown.face, variation, run.manifest.seed, 0);
    return {.title = shown.title,
            .sketch = render::RasteriseStrokes(seen.strokes, render::kSketchCanvas, seen.style),
            .truth = faces_.points(shown.face),
            .predictions = {}};
  }

  std::vector<ComparedPrediction> Predict(const std::vector<ComparedSketch>& shown, models::SketchRun& run,
                                          double strength) const {
    DAUMIER_CHECK(run.manifest.details.at("data") == data_, "{} was trained on other data than the first run",
                  run.directory.string());
    const at::NoGradGuard no_grad;
    std::vector<int> indices, all(shown.size());
    for (const ComparedSketch& one : shown) indices.push_back(one.face);
    std::iota(all.begin(), all.end(), 0);
    const datasets::SketchDataset images(sketches_, indices, run.network->options().resolution,
                                         VariationOf(run, strength), run.manifest.seed);
    const auto vertices =
        tensor::CopyToMatrix<float>(run.network->Decode(run.network->forward(images.Get(all).images)));
    std::vector<ComparedPrediction> predictions;
    for (size_t i = 0; i < shown.size(); ++i)
      predictions.push_back(Measure(indices[i], {vertices.row(Eigen::Index(i)).data(), size_t(vertices.cols())}));
    return predictions;
  }

 private:
  static datasets::SketchVariation VariationOf(const models::SketchRun& run, double strength) {
    datasets::SketchVariation variation;
    variation.wrinkles = run.config.at("sketch").at("wrinkles").get<bool>();
    variation.augmentation.strength = strength;
    return variation;
  }

  ComparedPrediction Measure(int face, std::span<const float> predicted) const {
    const std::vector<int>& region = face_template().annotation.regions.at("face");
    const double mm_per_cm = faces::MillimetresPerCm(face_template());
    const std::vector<double> errors = VertexErrors(predicted, faces_.vertices(face), mm_per_cm);
    ComparedPrediction prediction;
    prediction.face =
        Eigen::Map<const tensor::RowMajorMatrix<float>>(predicted.data(), Eigen::Index(predicted.size() / 3), 3)
            .cast<double>();
    prediction.error_mm =
        Eigen::VectorXd::Constant(Eigen::Index(errors.size()), std::numeric_limits<double>::quiet_NaN());
    for (const int vertex : region) prediction.error_mm[vertex] = errors[size_t(vertex)];
    prediction.mean_error_mm = MeanVertexError(predicted, faces_.vertices(face), region, mm_per_cm);
    return prediction;
  }

  const Json data_;
  const faces::FaceDatabase faces_;
  const datasets::SketchDatabase sketches_;
};

}  // namespace

render::Image SketchComparison(const std::vector<ComparedRun>& runs, const std::vector<ComparedSketch>& faces) {
  DAUMIER_CHECK(!runs.empty(), "a comparison needs a run");
  std::vector<std::string> names;
  std::vector<ComparedFace> rows;
  std::optional<Comparison> comparison;
  for (const ComparedRun& one : runs) {
    models::SketchRun run = models::LoadSketchRun(one.run);
    if (!comparison) {
      comparison.emplace(run);
      for (const ComparedSketch& face : faces) rows.push_back(comparison->Row(face, run, one.strength));
    }
    names.push_back(one.name);
    std::vector<ComparedPrediction> predictions = comparison->Predict(faces, run, one.strength);
    for (size_t i = 0; i < rows.size(); ++i) rows[i].predictions.push_back(std::move(predictions[i]));
  }
  return ComparisonSheet(comparison->face_template(), names, rows);
}

std::vector<ComparedSketch> ChooseFaces(const std::vector<int>& faces, const std::vector<double>& errors) {
  DAUMIER_CHECK(!faces.empty() && faces.size() == errors.size(), "{} faces have {} errors", faces.size(),
                errors.size());
  std::vector<size_t> order(faces.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return errors[a] < errors[b]; });
  const size_t last = order.size() - 1;
  return {{"median", faces[order[last / 2]]},
          {"95th percentile", faces[order[size_t(std::ceil(0.95 * double(last)))]]},
          {"first", faces.front()}};
}

}  // namespace daumier::eval
