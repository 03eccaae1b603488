#include "systems/deform/train/evaluation.h"

#include "core/error.h"
#include "core/evenly_spaced.h"
#include "core/files.h"
#include "core/log.h"
#include "core/run_manifest.h"
#include "core/stopwatch.h"
#include "datasets/read/run_data.h"
#include "systems/deform/train/measurement.h"
#include "systems/deform/train/run.h"
#include "tensor/eigen.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace daumier::deform {
namespace {

namespace fs = std::filesystem;

constexpr int kMostTraining = 2000, kMostValidation = 200;

/// Some faces of a database in a model's frame, (n, V, 3) float32.
torch::Tensor VerticesOf(const faces::FaceDatabase& database, const std::vector<int>& faces,
                         const faces::ModelFrame& frame) {
  torch::Tensor vertices = torch::empty({int64_t(faces.size()), database.num_vertices(), 3});
  for (size_t i = 0; i < faces.size(); ++i) {
    const geometry::Points points = frame.FromCm(database.points(faces[i]));
    vertices[int64_t(i)].copy_(tensor::CopyToTensor(points));
  }
  return vertices;
}

class DeformEvaluation {
 public:
  DeformEvaluation(const fs::path& run_directory, const DeformEvalOptions& options, FolderCache& databases,
                   const Task& task)
      : options_(options),
        run_(LoadDeformRun(run_directory)),
        own_(OpenOwnFaces(databases)),
        other_(OpenExternalFaces(databases)),
        split_(own_ == nullptr ? datasets::Split{}
                               : datasets::SplitOfRun(run_.directory, run_.manifest, run_.config, *own_)),
        measurement_(*run_.network, Faces(), run_.manifest.seed, Unit(), task) {}

  void Measure() {
    const Stopwatch stopwatch;
    CodeFitOptions fit{.data_weight = run_.data_weight, .code_weight = run_.code_weight};
    const int num_faces = measurement_.num_faces(), adam_faces = std::min(options_.adam_faces, num_faces);
    measurement_.MeasureNetwork("network", fit, num_faces);
    if (adam_faces > 0) {
      measurement_.MeasureNetwork("network, first faces by Gauss-Newton", fit, adam_faces);
      fit.solve.method = "adam";
      fit.solve.adam_steps = options_.adam_steps;
      measurement_.MeasureNetwork("network, first faces by Adam", fit, adam_faces);
    }
    if (options_.baselines) MeasureBaselines();
    seconds_ = stopwatch.seconds();
  }

  reports::MetricTable Table() const {
    reports::MetricTable table = measurement_.table();
    table.data_hash = DataHashes();
    return table;
  }

  Json Metrics() const {
    const reports::MetricTable table = Table();
    const reports::MetricRow& result = measurement_.result();
    const auto value = [&](const char* key) {
      const std::optional<double> number = reports::ValueOf(table, result, key);
      return number ? Json(*number) : Json();
    };
    Json metrics = {{"system", kSystem},
                    {"num_faces", table.faces.size()},
                    {"num_persons", NumPersons()},
                    {"split", other_ != nullptr ? Json() : Json(options_.split)},
                    {"unit", "model units"},
                    {"mm_per_unit", Unit().mm},
                    {"mean_vertex_error", result.error().mean},
                    {"interval", {result.error().interval->low, result.error().interval->high}},
                    {"mean_vertex_error_mm", value("error_mm")},
                    {"percent_of_head_height", value("percent_of_head_height")},
                    {"p95_vertex_error", value("p95")},
                    {"surface_sample_error", value("surface_sample_error")},
                    {"normal_error_degrees", value("normal_error_degrees")},
                    {"flipped_triangles", value("flipped_triangles")},
                    {"self_intersections", value("self_intersections")},
                    {"true_self_intersections", measurement_.true_self_intersections()},
                    {"table", reports::TableJson(table)},
                    {"ridge", baselines_ ? Json(baselines_->ridge()) : Json()},
                    {"components_for_99_percent", Json()},
                    {"data_hash", table.data_hash},
                    {"seconds", seconds_},
                    {"faces", table.faces},
                    {"groups", table.groups},
                    {"face_errors", result.face_errors}};
    if (baselines_ && baselines_->ComponentsFor(0.99))
      metrics["components_for_99_percent"] = *baselines_->ComponentsFor(0.99);
    return metrics;
  }

  reports::ReportData Report(const reports::Predictions& predictions) const {
    const faces::FaceTemplate& face_template = run_.face_template;
    const ModelUnit unit = Unit();
    reports::ReportData report;
    report.title =
        other_ != nullptr
            ? fmt::format("Deformable model of {} on other faces: {}", face_template.source, SourcesOf(*other_))
            : fmt::format("Deformable model: {}, {} split", face_template.source, options_.split);
    report.summary = fmt::format(
        "{} faces of {} persons, each by the code that is found for it with the network held fixed. Mean distance of "
        "all vertices; a unit of the model is {:.1f} mm, where the face from chin to hairline is 200 mm high, and the "
        "head is {:.2f} units high. Nothing is aligned before measuring. The interval resamples persons.",
        measurement_.num_faces(), NumPersons(), unit.mm, unit.head_height);
    report.surface = predictions.surface;
    report.samples =
        reports::ChosenSamples(measurement_.table(), predictions, [&](int face) { return measured().Describe(face); });
    report.mean_face = face_template.neutral;
    report.mean_error_mm = InMm(measurement_.mean_error_map());
    for (const double error : measurement_.result().face_errors) report.face_errors_mm.push_back(error * unit.mm);
    report.tables = {reports::TextTable(measurement_.table())};
    report.facts = {
        {"seed", fmt::format("{}", run_.manifest.seed)},
        {"network", fmt::format("{}, codes of {}", run_.network->options().kind, run_.network->options().latent)},
        {"training faces", fmt::format("{}", run_.codes.size(0))},
        {"seconds", fmt::format("{:.1f}", seconds_)}};
    const Json hashes = DataHashes();
    for (const auto& [name, hash] : hashes.items())
      report.facts.push_back({name + " (data hash)", hash.get<std::string>()});
    return report;
  }

  reports::Predictions KeptPredictions() const {
    reports::Predictions predictions{reports::SurfaceOf(run_.face_template), {}};
    const std::vector<int>& faces = measurement_.faces().faces;
    for (const int face : reports::KeptFaces(measurement_.table())) {
      const int i = int(std::find(faces.begin(), faces.end(), face) - faces.begin());
      const torch::Tensor predicted = measurement_.Predicted(i);
      predictions.faces.push_back({face,
                                   {},
                                   measured().points(face),
                                   run_.network->frame().ToCm(tensor::CopyToMatrix<double>(predicted)),
                                   InMm((predicted - measurement_.faces().vertices[i]).norm(2, {1}))});
    }
    return predictions;
  }

  Manifest ReportManifest() const {
    Manifest manifest{.kind = "report", .verb = "eval"};
    manifest.config = ToJson(options_);
    for (const char* folder : {"faces", "data"}) manifest.config.erase(folder);
    manifest.seed = run_.manifest.seed;
    manifest.sources = run_.manifest.sources;
    if (other_ != nullptr)
      for (const Json& source : other_->manifest().sources) manifest.sources.push_back(source);
    manifest.counts = {{"faces", measurement_.num_faces()}, {"persons", NumPersons()}};
    manifest.details = {
        {"system", kSystem}, {"data", DataHashes()}, {"weights", Sha256OfFile(BestWeights(run_.directory))}};
    return manifest;
  }

 private:
  /// Null of an imported run.
  const faces::FaceDatabase* OpenOwnFaces(FolderCache& databases) const {
    if (run_.is_imported()) {
      if (options_.faces.empty())
        throw UsageError(fmt::format(
            "{} was imported, and has no faces of its own: name registered faces of its topology by --faces FOLDER",
            run_.directory.string()));
      return nullptr;
    }
    const auto find = [&](const char* kind, const std::string& moved) {
      return datasets::FindRunData(run_.directory, run_.manifest, run_.config, kind, moved);
    };
    if (!options_.data.points.empty()) find("points", options_.data.points);
    return &databases.Open<faces::FaceDatabase>(find("faces", options_.data.faces));
  }

  /// Null if a subset of the run's split is measured.
  const faces::FaceDatabase* OpenExternalFaces(FolderCache& databases) const {
    if (options_.faces.empty()) return nullptr;
    const auto& faces = databases.Open<faces::FaceDatabase>(options_.faces);
    const auto& own = run_.face_template.triangles;
    const auto& other = faces.face_template().triangles;
    DAUMIER_CHECK(own.rows() == other.rows() && own == other,
                  "{} has faces of another topology than {} was trained on: register them to its template",
                  options_.faces, run_.directory.string());
    return &faces;
  }

  const faces::FaceDatabase& measured() const { return other_ != nullptr ? *other_ : *own_; }

  MeasuredFaces Faces() const {
    MeasuredFaces measured_faces;
    if (other_ != nullptr) {
      measured_faces.faces.resize(size_t(other_->num_faces()));
      std::iota(measured_faces.faces.begin(), measured_faces.faces.end(), 0);
    } else {
      measured_faces.faces = EvenlySpaced(datasets::SubsetOf(split_, options_.split), options_.max_faces);
      if (measured_faces.faces.empty())
        throw UsageError(fmt::format("the side '{}' of the split has no face", options_.split));
    }
    for (const int face : measured_faces.faces) measured_faces.groups.push_back(measured().group(face));
    measured_faces.vertices = VerticesOf(measured(), measured_faces.faces, run_.network->frame());
    measured_faces.triangles = run_.face_template.triangles;
    return measured_faces;
  }

  void MeasureBaselines() {
    measurement_.MeasureTemplate();
    if (own_ == nullptr) return log::Info("Baselines need faces of training, which an imported run does not have");
    log::Info("Fitting the baselines");
    const faces::ModelFrame frame = run_.network->frame();
    baselines_.emplace(VerticesOf(*own_, EvenlySpaced(split_.train, kMostTraining), frame),
                       VerticesOf(*own_, EvenlySpaced(split_.validation, kMostValidation), frame),
                       run_.network->options().latent);
    measurement_.MeasureBaselines(*baselines_);
  }

  ModelUnit Unit() const { return UnitOf(run_.face_template, run_.network->frame()); }
  int NumPersons() const {
    const std::vector<int>& groups = measurement_.faces().groups;
    return int(std::set<int>(groups.begin(), groups.end()).size());
  }
  /// "ict, registered meshes": of what faces were made.
  static std::string SourcesOf(const faces::FaceDatabase& database) {
    std::vector<std::string> names;
    for (const Json& source : database.manifest().sources) names.push_back(source.at("name").get<std::string>());
    return fmt::format("{}", fmt::join(names, ", "));
  }

  Json DataHashes() const {
    Json hashes = run_.manifest.details.at("data");
    if (other_ != nullptr) hashes["other_faces"] = DataHash(options_.faces);
    return hashes;
  }

  Eigen::VectorXd InMm(const torch::Tensor& distances) const {
    return tensor::CopyToMatrix<double>(distances.unsqueeze(1)) * Unit().mm;
  }

  const DeformEvalOptions options_;
  const DeformRun run_;
  const faces::FaceDatabase* const own_;  ///< Null of an imported run.
  const faces::FaceDatabase* const other_;
  const datasets::Split split_;
  DeformMeasurement measurement_;
  std::optional<DeformBaselines> baselines_;
  double seconds_ = 0;
};

}  // namespace

reports::Evaluation EvaluateDeformRun(const fs::path& run_directory, const DeformEvalOptions& options,
                                      FolderCache& databases, const Task& task) {
  DeformEvaluation evaluation(run_directory, options, databases, task);
  evaluation.Measure();
  const reports::Predictions predictions = evaluation.KeptPredictions();
  return {.table = evaluation.Table(),
          .metrics = evaluation.Metrics(),
          .report = evaluation.Report(predictions),
          .manifest = evaluation.ReportManifest(),
          .predictions = predictions};
}

}  // namespace daumier::deform
