#include "systems/deform/train/evaluation.h"

#include "core/error.h"
#include "core/even_choice.h"
#include "core/files.h"
#include "core/log.h"
#include "core/run_manifest.h"
#include "systems/deform/train/measurement.h"
#include "reports/chosen_faces.h"
#include "reports/report.h"
#include "datasets/read/run_data.h"
#include "systems/deform/train/run.h"
#include "tensor/eigen.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
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
  DeformEvaluation(const fs::path& run_directory, const DeformEvalOptions& options)
      : options_(options), run_(LoadDeformRun(run_directory)), own_(OpenOwnFaces()) {
    split_ = datasets::SplitOfRun(run_.directory, run_.manifest, run_.config, own_);
    if (!options.faces.empty()) OpenOtherFaces();
    measurement_.emplace(*run_.network, Faces(), run_.manifest.seed);
  }

  void Measure() {
    const auto start = std::chrono::steady_clock::now();
    CodeFitOptions fit{.data_weight = run_.data_weight, .code_weight = run_.code_weight};
    const int num_faces = measurement_->num_faces(), adam_faces = std::min(options_.adam_faces, num_faces);
    measurement_->MeasureNetwork("network", fit, num_faces);
    if (adam_faces > 0) {
      measurement_->MeasureNetwork("network, first faces by Gauss-Newton", fit, adam_faces);
      fit.solve.method = "adam";
      fit.solve.adam_steps = options_.adam_steps;
      measurement_->MeasureNetwork("network, first faces by Adam", fit, adam_faces);
    }
    if (options_.baselines) MeasureBaselines();
    seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  Json Metrics() const {
    const DeformRow& result = measurement_->result();
    const SurfaceErrors& mean = result.mean;
    const MeasuredFaces& faces = measurement_->faces();
    const ModelUnit unit = Unit();
    Json metrics = {{"system", kSystem},
                    {"num_faces", result.num_faces},
                    {"num_persons", NumPersons()},
                    {"split", other_ ? Json() : Json(options_.split)},
                    {"unit", "model units"},
                    {"mean_vertex_error", mean.mean_vertex_error},
                    {"interval", {result.interval.low, result.interval.high}},
                    {"mean_vertex_error_mm", mean.mean_vertex_error * unit.mm},
                    {"percent_of_head_height", 100 * mean.mean_vertex_error / unit.head_height},
                    {"p95_vertex_error", mean.p95_vertex_error},
                    {"surface_sample_error", mean.surface_sample_error},
                    {"normal_error_degrees", mean.normal_error_degrees},
                    {"flipped_triangles", mean.flipped_triangles},
                    {"self_intersections", *mean.self_intersections},
                    {"true_self_intersections", measurement_->true_self_intersections()},
                    {"table", DeformTableJson(measurement_->rows(), unit)},
                    {"ridge", baselines_ ? Json(baselines_->ridge()) : Json()},
                    {"components_for_99_percent", Json()},
                    {"data_hash", DataHashes()},
                    {"seconds", seconds_},
                    {"faces", faces.faces},
                    {"groups", faces.groups},
                    {"face_errors", measurement_->face_errors()}};
    if (baselines_ && baselines_->ComponentsFor(0.99))
      metrics["components_for_99_percent"] = *baselines_->ComponentsFor(0.99);
    return metrics;
  }

  reports::ReportData Report() const {
    const faces::FaceTemplate& face_template = run_.face_template;
    const ModelUnit unit = Unit();
    reports::ReportData report;
    report.title =
        other_ ? fmt::format("Deformable model of {} on other faces: {}", face_template.source, SourcesOf(*other_))
               : fmt::format("Deformable model: {}, {} split", face_template.source, options_.split);
    report.summary = fmt::format(
        "{} faces of {} persons, each by the code that is found for it with the network held fixed. eval::Mean distance of "
        "all vertices; a unit of the model is {:.1f} mm, where the face from chin to hairline is 200 mm high, and the "
        "head is {:.2f} units high. Nothing is aligned before measuring. The interval resamples persons.",
        measurement_->num_faces(), NumPersons(), unit.mm, unit.head_height);
    report.surface = {face_template.triangles, face_template.closing_triangles,
                      face_template.num_eye_closing_triangles};
    report.samples = Samples();
    report.mean_face = face_template.neutral;
    report.mean_error_mm = InMm(measurement_->mean_error_map());
    for (const double error : measurement_->face_errors()) report.face_errors_mm.push_back(error * unit.mm);
    report.tables = {DeformReportTable(measurement_->rows(), unit)};
    report.facts = {
        {"seed", fmt::format("{}", run_.manifest.seed)},
        {"network", fmt::format("{}, codes of {}", run_.network->options().kind, run_.network->options().latent)},
        {"training faces", fmt::format("{}", split_.train.size())},
        {"seconds", fmt::format("{:.1f}", seconds_)}};
    const Json hashes = DataHashes();
    for (const auto& [name, hash] : hashes.items())
      report.facts.push_back({name + " (data hash)", hash.get<std::string>()});
    return report;
  }

  std::string TableMarkdown() const { return DeformTableMarkdown(measurement_->rows(), Unit()); }

  Manifest ReportManifest() const {
    Manifest manifest;
    manifest.kind = "report";
    manifest.verb = "eval";
    manifest.config = ToJson(options_);
    manifest.config.erase("faces");
    manifest.seed = run_.manifest.seed;
    manifest.sources = run_.manifest.sources;
    if (other_)
      for (const Json& source : other_->manifest().sources) manifest.sources.push_back(source);
    manifest.counts = {{"faces", measurement_->num_faces()}, {"persons", NumPersons()}};
    manifest.details = {{"system", kSystem},
                        {"data", DataHashes()},
                        {"weights", Sha256OfFile(BestWeights(run_.directory))}};
    return manifest;
  }

 private:
  faces::FaceDatabase OpenOwnFaces() const {
    datasets::CheckSameData(run_.directory, run_.manifest, run_.config, "faces");
    return faces::FaceDatabase(run_.config.at("data").at("faces").get<std::string>());
  }

  void OpenOtherFaces() {
    other_.emplace(options_.faces);
    const auto& own = run_.face_template.triangles;
    const auto& other = other_->face_template().triangles;
    DAUMIER_CHECK(own.rows() == other.rows() && own == other,
                  "{} holds faces of another topology than {} was trained on: register them to its template",
                  options_.faces, run_.directory.string());
  }

  const faces::FaceDatabase& measured() const { return other_ ? *other_ : own_; }

  MeasuredFaces Faces() const {
    MeasuredFaces measured_faces;
    if (other_) {
      measured_faces.faces.resize(size_t(other_->num_faces()));
      std::iota(measured_faces.faces.begin(), measured_faces.faces.end(), 0);
    } else {
      measured_faces.faces = EvenChoice(datasets::SideOf(split_, options_.split), options_.max_faces);
      if (measured_faces.faces.empty())
        throw UsageError(fmt::format("the side '{}' of the split has no face", options_.split));
    }
    for (const int face : measured_faces.faces) measured_faces.groups.push_back(measured().group(face));
    measured_faces.vertices = VerticesOf(measured(), measured_faces.faces, run_.network->frame());
    measured_faces.triangles = run_.face_template.triangles;
    return measured_faces;
  }

  void MeasureBaselines() {
    log::Info("Fitting the baselines");
    const faces::ModelFrame frame = run_.network->frame();
    baselines_.emplace(VerticesOf(own_, EvenChoice(split_.train, kMostTraining), frame),
                       VerticesOf(own_, EvenChoice(split_.validation, kMostValidation), frame),
                       run_.network->options().latent);
    measurement_->MeasureBaselines(*baselines_);
  }

  ModelUnit Unit() const { return UnitOf(run_.face_template, run_.network->frame()); }
  int NumPersons() const {
    const std::vector<int>& groups = measurement_->faces().groups;
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
    if (other_) hashes["other_faces"] = DataHash(options_.faces);
    return hashes;
  }

  Eigen::VectorXd InMm(const torch::Tensor& distances) const {
    return tensor::CopyToMatrix<double>(distances.unsqueeze(1)) * Unit().mm;
  }

  std::vector<reports::ReportSample> Samples() const {
    const std::vector<int>& faces = measurement_->faces().faces;
    const std::vector<double>& errors = measurement_->face_errors();
    std::vector<reports::ReportSample> samples;
    for (const reports::ChosenFace& chosen : reports::ChooseFaces(faces, errors)) {
      const int i = int(std::find(faces.begin(), faces.end(), chosen.face) - faces.begin());
      const torch::Tensor predicted = measurement_->Predicted(i);
      reports::ReportSample sample;
      sample.title = fmt::format("{}: {:.2f} mm; {}", chosen.title, errors[size_t(i)] * Unit().mm,
                                 measured().Describe(chosen.face));
      sample.truth = measured().points(chosen.face);
      sample.prediction = run_.network->frame().ToCm(tensor::CopyToMatrix<double>(predicted));
      sample.error_mm = InMm((predicted - measurement_->faces().vertices[i]).norm(2, {1}));
      samples.push_back(std::move(sample));
    }
    return samples;
  }

  const DeformEvalOptions options_;
  const DeformRun run_;
  const faces::FaceDatabase own_;
  std::optional<faces::FaceDatabase> other_;
  datasets::Split split_;
  std::optional<DeformMeasurement> measurement_;
  std::optional<DeformBaselines> baselines_;
  double seconds_ = 0;
};

}  // namespace

Json EvaluateDeformRun(const fs::path& run_directory, const fs::path& out_directory, const DeformEvalOptions& options) {
  DeformEvaluation evaluation(run_directory, options);
  evaluation.Measure();
  const Json metrics = evaluation.Metrics();
  MakeDirectory(out_directory);
  reports::WriteReport(out_directory, evaluation.Report());
  WriteFileAtomically(out_directory / "table.md", evaluation.TableMarkdown());
  WriteFileAtomically(out_directory / "metrics.json", metrics.dump(2) + "\n");
  Manifest manifest = evaluation.ReportManifest();
  for (const char* name : {"metrics.json", "table.md", "sheet.png", "mean_error.png", "errors.svg", "index.html"})
    manifest.checksums[name] = Sha256OfFile(out_directory / name);
  WriteManifest(out_directory, manifest);
  return metrics;
}

}  // namespace daumier::deform
