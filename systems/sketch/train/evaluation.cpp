#include "systems/sketch/train/evaluation.h"

#include "core/files.h"
#include "core/manifest.h"
#include "core/run_manifest.h"
#include "reports/report.h"
#include "systems/sketch/train/measurement.h"
#include "systems/sketch/train/run_data.h"
#include "geometry/coordinates.h"
#include "render/strokes.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

namespace daumier::sketch {
namespace {

namespace fs = std::filesystem;

/// Null where it was not measured.
Json BaselineError(const SketchMeasurement& measured, const std::string& name) {
  const std::optional<double> error = measured.error_of(name);
  return error ? Json(*error) : Json();
}

Json MetricsOf(const SketchMeasurement& measured, double seconds) {
  const ErrorRow& result = measured.result();
  return {{"num_faces", measured.faces().size()},
          {"num_persons", measured.num_persons()},
          {"split", measured.options().split},
          {"shape_input", result.shape_input},
          {"augmentation_strength", measured.options().strength},
          {"shape_error_px", measured.shape_error_px()},
          {"mean_vertex_error_mm", result.error_mm},
          {"interval_mm", {result.interval_mm.low, result.interval_mm.high}},
          {"p90_vertex_error_mm", result.p90_mm},
          {"interocular_share", result.interocular_share},
          {"regions_mm", measured.region_errors_mm()},
          {"mean_face_baseline_mm", BaselineError(measured, "mean face")},
          {"nearest_neighbour_mm", BaselineError(measured, "nearest neighbour")},
          {"ridge_mm", BaselineError(measured, "ridge regression")},
          {"ridge_lambda", measured.options().baselines ? Json(measured.ridge_lambda()) : Json()},
          {"model_limit_mm", BaselineError(measured, "limit of the model")},
          {"table", TableJson(measured.rows())},
          {"data_hash", measured.data().run.manifest.details.at("data")},
          {"seconds", seconds},
          {"faces", measured.faces()},
          {"groups", measured.groups()},
          {"face_errors_mm", measured.errors_mm()}};
}

reports::ReportSample SampleOf(const SketchMeasurement& measured, const std::string& what, int index) {
  const int face = measured.faces()[size_t(index)];
  const eval::FaceRows prediction = measured.PredictResult(std::span(&face, 1));
  reports::ReportSample sample;
  sample.title =
      fmt::format("{}: {:.2f} mm; {}", what, measured.errors_mm()[size_t(index)], measured.data().faces.Describe(face));
  const auto seen = measured.Seen(face);
  sample.sketch = render::RasteriseStrokes(seen.strokes, render::kSketchCanvas, seen.style);
  sample.truth = measured.data().faces.points(face);
  sample.prediction = geometry::PointsFrom(eval::RowSpan(prediction, 0));
  sample.error_mm = measured.ErrorMap(prediction, face);
  return sample;
}

/// The median, the worst 5 % (where they begin, and the worst) and the first by index.
std::vector<reports::ReportSample> SamplesOf(const SketchMeasurement& measured) {
  const std::vector<double>& errors = measured.errors_mm();
  std::vector<int> order(errors.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return errors[size_t(a)] < errors[size_t(b)]; });
  const size_t last = order.size() - 1;
  return {SampleOf(measured, "median", order[last / 2]),
          SampleOf(measured, "95th percentile", order[size_t(std::ceil(0.95 * double(last)))]),
          SampleOf(measured, "worst", order[last]), SampleOf(measured, "first", 0)};
}

reports::ReportData ReportOf(const SketchMeasurement& measured, double seconds) {
  const SketchRun& run = measured.data().run;
  const faces::FaceTemplate& face_template = run.face_template;
  reports::ReportData report;
  report.title = fmt::format("Sketch to face: {}, {} split", face_template.source, measured.options().split);
  report.summary = fmt::format(
      "{} faces of {} persons. eval::Mean distance of vertices over the face region in millimetres, where the face from chin "
      "to hairline is 200 mm high; nothing is aligned before measuring. The interval resamples persons.",
      measured.faces().size(), measured.num_persons());
  report.surface = {face_template.triangles, face_template.closing_triangles, face_template.num_eye_closing_triangles};
  report.samples = SamplesOf(measured);
  report.mean_face = face_template.neutral;
  report.mean_error_mm = measured.mean_error_map();
  report.face_errors_mm = measured.errors_mm();
  const std::vector<std::vector<std::string>> cells = TableCells(measured.rows());
  reports::ReportTable table{"Errors", cells.front(), {}};
  table.rows.assign(cells.begin() + 1, cells.end());
  report.tables = {table};
  const Json& hashes = run.manifest.details.at("data");
  report.facts = {{"faces (data hash)", hashes.at("faces").get<std::string>()},
                  {"sketches (data hash)", hashes.at("sketches").get<std::string>()},
                  {"seed", fmt::format("{}", run.manifest.seed)},
                  {"split", fmt::format("{} ({} training faces)", run.config.at("split").at("kind").get<std::string>(),
                                        measured.data().split.train.size())},
                  {"seconds", fmt::format("{:.1f}", seconds)}};
  if (measured.options().baselines)
    report.facts.push_back(
        {"ridge's lambda, chosen on validation faces", fmt::format("{:g}", measured.ridge_lambda())});
  return report;
}

void WriteReportManifest(const fs::path& folder, const SketchRunData& data, const SketchEvalOptions& options,
                         const Json& metrics) {
  Manifest manifest;
  manifest.kind = "report";
  manifest.verb = "eval";
  manifest.config = {{"split", options.split}, {"strength", options.strength}};
  manifest.seed = data.run.manifest.seed;
  manifest.sources = data.run.manifest.sources;
  manifest.counts = {{"faces", metrics.at("num_faces")}, {"persons", metrics.at("num_persons")}};
  const auto weights = [](const fs::path& run) { return Sha256OfFile(BestWeights(run)); };
  manifest.details = {{"data", data.run.manifest.details.at("data")}, {"weights", weights(data.run.directory)}};
  if (!options.recover_with.empty()) manifest.details["recovering_weights"] = weights(options.recover_with);
  for (const char* name : {"metrics.json", "table.md", "sheet.png", "mean_error.png", "errors.svg", "index.html"})
    manifest.checksums[name] = Sha256OfFile(folder / name);
  WriteManifest(folder, manifest);
}

}  // namespace

Json EvaluateSketchRun(const fs::path& run_directory, const fs::path& out_directory, const SketchEvalOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const SketchRunData data = OpenSketchRunData(run_directory);
  SketchMeasurement measurement(data, options);
  measurement.Measure();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  Json metrics = MetricsOf(measurement, seconds);

  MakeDirectory(out_directory);
  reports::WriteReport(out_directory, ReportOf(measurement, seconds));
  WriteFileAtomically(out_directory / "table.md", TableMarkdown(measurement.rows()));
  WriteFileAtomically(out_directory / "metrics.json", metrics.dump(2) + "\n");
  WriteReportManifest(out_directory, data, options, metrics);
  return metrics;
}

}  // namespace daumier::sketch
