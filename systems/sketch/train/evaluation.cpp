#include "systems/sketch/train/evaluation.h"

#include "core/error.h"
#include "core/files.h"
#include "core/run_manifest.h"
#include "core/stopwatch.h"
#include "systems/sketch/metrics.h"
#include "systems/sketch/train/external_evaluation.h"
#include "systems/sketch/train/measurement.h"
#include "systems/sketch/train/stroke_prefixes.h"

#include <algorithm>

namespace daumier::sketch {
namespace {

namespace fs = std::filesystem;

/// What the parts of an evaluation are made of.
struct Measured {
  const SketchTestSet& test;
  const SketchEvalOptions& options;
  SketchMeasurement measurement;
  std::optional<PrefixReport> prefixes;
  double seconds;

  const SketchRun& run() const { return test.data().run; }
  const reports::MetricTable& table() const { return measurement.table; }
  const reports::MetricRow& result() const { return reports::FindRow(table(), ""); }
  double result(const std::string& column) const { return *reports::ValueOf(table(), result(), column); }
};

/// Null if it was not measured.
Json ErrorOf(const reports::MetricTable& table, const std::string& name) {
  const auto row = std::find_if(table.rows.begin(), table.rows.end(),
                                [&](const reports::MetricRow& one) { return one.name == name; });
  return row == table.rows.end() ? Json() : Json(row->error().mean);
}

Json MetricsOf(const Measured& measured) {
  const reports::MetricTable& table = measured.table();
  const reports::MetricRow& result = measured.result();
  const std::optional<double>& lambda = measured.measurement.ridge_lambda;
  return {{"num_faces", table.faces.size()},
          {"num_persons", measured.test.num_persons()},
          {"split", measured.options.split},
          {"shape_input", result.input},
          {"augmentation_strength", measured.options.strength},
          {"styled", measured.options.styled},
          {"shape_error_px", measured.measurement.shape_error_px},
          {"mean_vertex_error_mm", result.error().mean},
          {"interval_mm", {result.error().interval->low, result.error().interval->high}},
          {"p90_vertex_error_mm", measured.result("p90")},
          {"interocular_share", measured.result("interocular_share")},
          {"regions_mm", measured.test.RegionErrors(measured.measurement.of_vertices)},
          {"mean_face_baseline_mm", ErrorOf(table, kMeanFace)},
          {"nearest_neighbour_mm", ErrorOf(table, kNearestNeighbour)},
          {"ridge_mm", ErrorOf(table, kRidge)},
          {"ridge_lambda", lambda ? Json(*lambda) : Json()},
          {"model_limit_mm", ErrorOf(table, kModelLimit)},
          {"strokes", measured.prefixes ? measured.prefixes->metrics : Json()},
          {"table", reports::TableJson(table)},
          {"data_hash", table.data_hash},
          {"seconds", measured.seconds},
          {"faces", table.faces},
          {"groups", table.groups},
          {"face_errors_mm", result.face_errors}};
}

reports::ReportData ReportOf(const Measured& measured) {
  const SketchRun& run = measured.run();
  const SketchRunData& data = measured.test.data();
  const reports::MetricTable& table = measured.table();
  reports::ReportData report;
  report.title = fmt::format("Sketch to face: {}, {} split", run.face_template.source, measured.options.split);
  report.summary = fmt::format(
      "{} faces of {} persons. Mean distance of vertices over the face region in millimetres, where the face from chin "
      "to hairline is 200 mm high; nothing is aligned before measuring. The interval resamples persons.",
      table.faces.size(), measured.test.num_persons());
  report.surface = reports::SurfaceOf(run.face_template);
  report.samples = reports::ChosenSamples(table, measured.measurement.predictions,
                                          [&](int face) { return data.faces.Describe(face); });
  report.mean_face = run.face_template.neutral;
  report.mean_error_mm = measured.test.InRegion(measured.measurement.of_vertices);
  report.face_errors_mm = measured.result().face_errors;
  report.tables = {reports::TextTable(table)};
  report.facts = {{"faces (data hash)", table.data_hash.at("faces").get<std::string>()},
                  {"sketches (data hash)", table.data_hash.at("sketches").get<std::string>()},
                  {"seed", fmt::format("{}", run.manifest.seed)},
                  {"split", fmt::format("{} ({} training faces)", run.config.at("split").at("kind").get<std::string>(),
                                        data.split.train.size())},
                  {"seconds", fmt::format("{:.1f}", measured.seconds)}};
  if (const std::optional<double>& lambda = measured.measurement.ridge_lambda)
    report.facts.push_back({"ridge's lambda, chosen on validation faces", fmt::format("{:g}", *lambda)});
  if (measured.prefixes) {
    report.tables.push_back(measured.prefixes->table);
    report.charts.push_back(measured.prefixes->chart);
    for (const reports::ReportFact& fact : measured.prefixes->facts) report.facts.push_back(fact);
  }
  return report;
}

Manifest ManifestOf(const Measured& measured) {
  const auto weights = [](const fs::path& run) { return Sha256OfFile(BestWeights(run)); };
  const SketchEvalOptions& options = measured.options;
  Manifest manifest{.kind = "report", .verb = "eval"};
  manifest.config = {{"split", options.split},
                     {"strength", options.strength},
                     {"styled", options.styled},
                     {"strokes", options.strokes}};
  manifest.seed = measured.run().manifest.seed;
  manifest.sources = measured.run().manifest.sources;
  manifest.counts = {{"faces", measured.table().faces.size()}, {"persons", measured.test.num_persons()}};
  manifest.details = {{"data", measured.table().data_hash}, {"weights", weights(measured.run().directory)}};
  if (!options.recover_with.empty()) manifest.details["recovering_weights"] = weights(options.recover_with);
  return manifest;
}

}  // namespace

reports::Evaluation EvaluateSketchRun(const fs::path& run_directory, const SketchEvalOptions& options,
                                      FolderCache& databases, const Task& task) {
  CheckEvalOptions(options);
  if (!options.faces.empty()) return EvaluateOnExternalFaces(run_directory, options, databases, task);
  const Stopwatch stopwatch;
  const SketchRunData data = OpenSketchRunData(run_directory, databases, options.data);
  const SketchTestSet test(data, options, task);
  Measured measured{test, options, MeasureSketchRun(test, options), {}, 0};
  if (options.strokes > 0)
    measured.prefixes =
        ReportPrefixes(MeasurePrefixes(test, options.strokes, options.parser, options.fitting), data.run.manifest.seed);
  measured.seconds = stopwatch.seconds();
  return {.table = measured.table(),
          .metrics = MetricsOf(measured),
          .report = ReportOf(measured),
          .manifest = ManifestOf(measured),
          .predictions = measured.measurement.predictions};
}

}  // namespace daumier::sketch
