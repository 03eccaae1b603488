#include "eval/sketch_eval.h"

#include "core/error.h"
#include "core/files.h"
#include "core/log.h"
#include "core/manifest.h"
#include "core/parallel.h"
#include "datasets/read/sketch_dataset.h"
#include "datasets/read/training_fit.h"
#include "eval/baselines.h"
#include "eval/metrics.h"
#include "eval/report.h"
#include "eval/shape_input.h"
#include "eval/sketch_run_data.h"
#include "eval/table.h"
#include "render/strokes.h"
#include "tensor/eigen.h"
#include "tensor/torch_version.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <set>

namespace daumier::eval {
namespace {

namespace fs = std::filesystem;

/// Faces that are predicted at once.
constexpr size_t kBlock = 64;

constexpr const char* kNetwork = "network";
constexpr const char* kRidge = "ridge regression";
constexpr const char* kNearest = "nearest neighbour";
constexpr const char* kMeanFace = "mean face";
constexpr const char* kLimit = "limit of the model";
constexpr const char* kShapeRidge = "ridge on shape numbers";

/// num_faces x 3V coordinates in cm of some faces of the database.
using Predictor = std::function<FaceRows(std::span<const int> faces)>;

class SketchEvaluation {
 public:
  SketchEvaluation(const SketchRunData& data, const std::string& side_name, double strength)
      : data_(data),
        side_name_(side_name),
        test_(data.side(side_name)),
        annotation_(data.faces.face_template().annotation),
        region_(annotation_.regions.at("face")),
        mm_per_cm_(faces::MillimetresPerCm(data.faces.face_template())),
        curves_(datasets::FitCurvesOnTraining(data.faces, data.sketches, data.split, data.bilinear)),
        shape_input_(curves_.model, data.sketches, data.faces.face_template()),
        mean_error_map_(size_t(data.faces.num_vertices()), 0) {
    variation_.wrinkles = data.sketch.wrinkles;
    variation_.augmentation.strength = strength;
    if (test_.empty()) throw UsageError(fmt::format("the split has no {} face", side_name));
    for (const int face : test_) {
      groups_.push_back(data.faces.group(face));
      for (const int person : data.faces.persons(face)) persons_.insert(person);
      const std::span<const float> truth = data.faces.vertices(face);
      interocular_mm_.push_back(mm_per_cm_ *
                                VertexDistance(truth, annotation_.landmarks[36], annotation_.landmarks[45]));
    }
  }

  /// Fits the baselines, predicts with all and fills the rows.
  void Measure() {
    Encode();
    const SketchSamples samples{[this](int face) { return data_.faces.vertices(face); },
                                [this](int face) { return CurvePoints(face); }};
    log::Info("Predicting {} {} faces by the network", test_.size(), side_name_);
    network_errors_mm_ = Errors([this](auto faces) { return PredictByNetwork(faces); }, &mean_error_map_);
    AddRow(kNetwork, network_errors_mm_);

    log::Info("Fitting the free baselines on {} training faces", data_.split.train.size());
    const RidgeFit ridge = FitRidge(samples, data_.split.train, data_.split.validation, region_, DefaultRidgeLambdas());
    ridge_lambda_ = ridge.lambda;
    AddRow(kRidge, Errors([&](auto faces) { return ridge.model.Predict(RowsOf(samples.curve_points, faces)); }));
    MeasureShapeInput();
    const NearestNeighbour nearest(samples, data_.split.train);
    AddRow(kNearest, Errors([&](auto faces) {
             return Rows(faces, [&](int face) {
               return AsVector(samples.vertices(nearest.Nearest(samples.curve_points(face))));
             });
           }));
    const Eigen::VectorXf mean_face = MeanFace(samples, data_.split.train);
    AddRow(kMeanFace, Errors([&](auto faces) { return Rows(faces, [&](int) { return mean_face; }); }));
    log::Info("Projecting the true faces on the bilinear model");
    const faces::BilinearProjector projector(data_.run.bilinear, RegionWeights());
    AddRow(kLimit, Errors([&](auto faces) {
             return Rows(faces, [&](int face) { return projector.Project(data_.faces.vertices(face)).vertices; });
           }));
  }

  Json Metrics(double seconds) const {
    const ErrorRow& network = Row(kNetwork);
    return {{"num_faces", test_.size()},
            {"num_persons", persons_.size()},
            {"split", side_name_},
            {"shape_input", "none"},
            {"augmentation_strength", variation_.augmentation.strength},
            {"shape_error_px", shape_error_px_},
            {"mean_vertex_error_mm", network.error_mm},
            {"interval_mm", {network.interval_mm.low, network.interval_mm.high}},
            {"p90_vertex_error_mm", network.p90_mm},
            {"interocular_share", network.interocular_share},
            {"mean_face_baseline_mm", Row(kMeanFace).error_mm},
            {"nearest_neighbour_mm", Row(kNearest).error_mm},
            {"ridge_mm", Row(kRidge).error_mm},
            {"ridge_lambda", ridge_lambda_},
            {"model_limit_mm", Row(kLimit).error_mm},
            {"table", TableJson(rows_)},
            {"data_hash", data_.run.manifest.details.at("data")},
            {"seconds", seconds}};
  }

  ReportData Report(double seconds) const {
    const faces::FaceTemplate& face_template = data_.run.face_template;
    ReportData report;
    report.title = fmt::format("Sketch to face: {}, {} split", face_template.source, side_name_);
    report.summary = fmt::format(
        "{} faces of {} persons. Mean distance of vertices over the face region in millimetres, where the face from "
        "chin "
        "to hairline is 200 mm high; nothing is aligned before measuring. The interval resamples persons.",
        test_.size(), persons_.size());
    report.surface = {face_template.triangles, face_template.closing_triangles,
                      face_template.num_eye_closing_triangles};
    report.samples = Samples();
    report.mean_face = face_template.neutral;
    report.mean_error_mm = RegionOnly(mean_error_map_);
    report.face_errors_mm = network_errors_mm_;
    std::vector<std::vector<std::string>> cells = TableCells(rows_);
    ReportTable table{"Errors", cells.front(), {}};
    table.rows.assign(cells.begin() + 1, cells.end());
    report.tables = {table};
    report.facts = {
        {"faces (data hash)", data_.run.manifest.details.at("data").at("faces").get<std::string>()},
        {"sketches (data hash)", data_.run.manifest.details.at("data").at("sketches").get<std::string>()},
        {"seed", fmt::format("{}", data_.run.manifest.seed)},
        {"split", fmt::format("{} ({} training faces)", data_.run.config.at("split").at("kind").get<std::string>(),
                              data_.split.train.size())},
        {"ridge's lambda, chosen on validation faces", fmt::format("{:g}", ridge_lambda_)},
        {"seconds", fmt::format("{:.1f}", seconds)}};
    return report;
  }

  const std::vector<ErrorRow>& rows() const { return rows_; }

 private:
  static Eigen::VectorXf AsVector(std::span<const float> face) {
    return Eigen::Map<const Eigen::VectorXf>(face.data(), Eigen::Index(face.size()));
  }

  /// One prediction a face, worked out by all cores.
  FaceRows Rows(std::span<const int> faces, const std::function<Eigen::VectorXf(int face)>& predict) const {
    FaceRows rows(Eigen::Index(faces.size()), 3 * Eigen::Index(data_.faces.num_vertices()));
    Eigen::Index next = 0;
    ForEachInOrder(
        int(faces.size()), [&](int i) { return predict(faces[size_t(i)]); },
        [&](Eigen::VectorXf face) { rows.row(next++) = face.transpose(); });
    return rows;
  }

  static FaceRows RowsOf(const std::function<std::vector<float>(int face)>& numbers, std::span<const int> faces) {
    FaceRows rows(Eigen::Index(faces.size()), Eigen::Index(numbers(faces[0]).size()));
    for (size_t i = 0; i < faces.size(); ++i) rows.row(Eigen::Index(i)) = AsVector(numbers(faces[i])).transpose();
    return rows;
  }

  datasets::AugmentedSketch Seen(int face) const {
    return datasets::VariedSketch(data_.sketches, face, variation_, data_.run.manifest.seed, 0);
  }

  static std::vector<float> AsNumbers(const Eigen::VectorXf& vector) {
    return {vector.data(), vector.data() + vector.size()};
  }

  /// The exact points of all curves, or those that are rebuilt from an augmented sketch.
  std::vector<float> CurvePoints(int face) const {
    if (variation_.augmentation.strength == 0) return data_.sketches.curve_points(face);
    return AsNumbers(codes_[size_t(face)].points);
  }

  /// The shape-level numbers of all faces that are seen here, from labelled strokes.
  void Encode() {
    codes_.resize(size_t(data_.faces.num_faces()));
    std::set<int> faces(data_.split.train.begin(), data_.split.train.end());
    faces.insert(data_.split.validation.begin(), data_.split.validation.end());
    faces.insert(test_.begin(), test_.end());
    log::Info("Encoding the curves of {} faces", faces.size());
    const std::vector<int> order(faces.begin(), faces.end());
    auto next = order.begin();
    ForEachInOrder(
        int(order.size()),
        [&](int i) {
          const auto sketch = Seen(order[size_t(i)]);
          return shape_input_.Given(sketch.moved, sketch.visible);
        },
        [&](faces::CurveCode code) { codes_[size_t(*next++)] = std::move(code); });
  }

  /// Ridge regression on the shape-level numbers, fitted on given ones, tested on given, predicted and recovered ones.
  void MeasureShapeInput() {
    const SketchSamples samples{[this](int face) { return data_.faces.vertices(face); },
                                [this](int face) { return AsNumbers(codes_[size_t(face)].numbers()); }};
    const RidgeFit ridge = FitRidge(samples, data_.split.train, data_.split.validation, region_, DefaultRidgeLambdas());
    const auto measure = [&](const std::string& name, const std::string& input,
                             const std::function<faces::CurveCode(int face, std::span<const float> predicted)>& code) {
      double error_px = 0;
      AddRow(name, Errors([&](std::span<const int> faces) {
               const FaceRows predicted = PredictByNetwork(faces);
               FaceRows numbers(predicted.rows(), codes_[size_t(test_[0])].numbers().size());
               for (size_t i = 0; i < faces.size(); ++i) {
                 const auto row = predicted.row(Eigen::Index(i));
                 const faces::CurveCode one = code(faces[i], {row.data(), size_t(row.size())});
                 error_px += shape_input_.ErrorPx(one, Seen(faces[i]).moved) / double(test_.size());
                 numbers.row(Eigen::Index(i)) = one.numbers().transpose();
               }
               return ridge.model.Predict(numbers);
             }));
      rows_.back().shape_input = input;
      shape_error_px_[input] = error_px;
    };
    measure(kShapeRidge, "given", [&](int face, auto) { return codes_[size_t(face)]; });
    measure(kShapeRidge, "predicted", [&](int face, auto predicted) {
      return shape_input_.Recovered(predicted, Seen(face).strokes, {.snaps = 0});
    });
    measure(kShapeRidge, "recovered",
            [&](int face, auto predicted) { return shape_input_.Recovered(predicted, Seen(face).strokes); });
  }

  FaceRows PredictByNetwork(std::span<const int> faces) const {
    const at::NoGradGuard no_grad;
    models::SketchNetwork network = data_.run.network;
    const datasets::SketchDataset images(data_.sketches, {faces.begin(), faces.end()}, network->options().resolution,
                                         variation_, data_.run.manifest.seed);
    std::vector<int> all(faces.size());
    std::iota(all.begin(), all.end(), 0);
    return tensor::CopyToMatrix<float>(network->Decode(network->forward(images.Get(all).images)));
  }

  Eigen::VectorXf RegionWeights() const {
    Eigen::VectorXf weights = Eigen::VectorXf::Zero(3 * Eigen::Index(data_.faces.num_vertices()));
    for (const int vertex : region_) weights.segment<3>(3 * vertex).setOnes();
    return weights;
  }

  /// One error a test face in mm; adds the mean distance of each vertex to `map` where one is given.
  std::vector<double> Errors(const Predictor& predict, std::vector<double>* map = nullptr) const {
    std::vector<double> errors;
    for (size_t begin = 0; begin < test_.size(); begin += kBlock) {
      const std::span<const int> block = std::span(test_).subspan(begin, std::min(kBlock, test_.size() - begin));
      const FaceRows predicted = predict(block);
      for (size_t i = 0; i < block.size(); ++i) {
        const std::span<const float> prediction(predicted.row(Eigen::Index(i)).data(), size_t(predicted.cols()));
        const std::span<const float> truth = data_.faces.vertices(block[i]);
        errors.push_back(MeanVertexError(prediction, truth, region_, mm_per_cm_));
        if (map == nullptr) continue;
        const std::vector<double> distances = VertexErrors(prediction, truth, mm_per_cm_);
        for (size_t vertex = 0; vertex < distances.size(); ++vertex)
          (*map)[vertex] += distances[vertex] / double(test_.size());
      }
    }
    return errors;
  }

  void AddRow(const std::string& name, const std::vector<double>& errors_mm) {
    rows_.push_back(MakeErrorRow(name, errors_mm, interocular_mm_, groups_, data_.run.manifest.seed));
  }

  const ErrorRow& Row(const std::string& name) const {
    return *std::find_if(rows_.begin(), rows_.end(), [&](const ErrorRow& row) { return row.name == name; });
  }

  Eigen::VectorXd RegionOnly(const std::vector<double>& errors) const {
    Eigen::VectorXd kept =
        Eigen::VectorXd::Constant(Eigen::Index(errors.size()), std::numeric_limits<double>::quiet_NaN());
    for (const int vertex : region_) kept[vertex] = errors[size_t(vertex)];
    return kept;
  }

  /// The median, the worst 5 % (where they begin, and the worst) and the first by index.
  std::vector<ReportSample> Samples() const {
    std::vector<int> order(test_.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return network_errors_mm_[size_t(a)] < network_errors_mm_[size_t(b)]; });
    const size_t last = order.size() - 1;
    return {Sample("median", order[last / 2]), Sample("95th percentile", order[size_t(std::ceil(0.95 * double(last)))]),
            Sample("worst", order[last]), Sample("first", 0)};
  }

  ReportSample Sample(const std::string& what, int test_index) const {
    const int face = test_[size_t(test_index)];
    const FaceRows prediction = PredictByNetwork(std::span(&face, 1));
    ReportSample sample;
    sample.title =
        fmt::format("{}: {:.2f} mm; {}", what, network_errors_mm_[size_t(test_index)], data_.faces.Describe(face));
    const auto seen = Seen(face);
    sample.sketch = render::RasteriseStrokes(seen.strokes, render::kSketchCanvas, seen.style);
    sample.truth = data_.faces.points(face);
    sample.prediction = Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>>(
                            prediction.data(), sample.truth.rows(), 3)
                            .cast<double>();
    sample.error_mm = RegionOnly(
        VertexErrors({prediction.data(), size_t(prediction.size())}, data_.faces.vertices(face), mm_per_cm_));
    return sample;
  }

  const SketchRunData& data_;
  const std::string side_name_;
  const std::vector<int>& test_;
  const faces::Annotation& annotation_;
  const std::vector<int>& region_;
  const double mm_per_cm_;
  const datasets::FittedBilinear curves_;  ///< 2-D model of the training sketches.
  const ShapeInput shape_input_;
  datasets::SketchVariation variation_;  ///< Of the sketches that are tested.
  std::vector<faces::CurveCode> codes_;  ///< Of every face that is seen.
  Json shape_error_px_ = Json::object();
  std::set<int> persons_;    ///< Who is seen.
  std::vector<int> groups_;  ///< Of each test face: what is resampled as one.
  std::vector<double> interocular_mm_, network_errors_mm_, mean_error_map_;
  std::vector<ErrorRow> rows_;
  double ridge_lambda_ = 0;
};

void WriteReportManifest(const fs::path& folder, const SketchRunData& data, const Json& metrics) {
  Manifest manifest;
  manifest.kind = "report";
  manifest.verb = "eval";
  manifest.config = {{"split", metrics.at("split")}, {"strength", metrics.at("augmentation_strength")}};
  manifest.seed = data.run.manifest.seed;
  manifest.sources = data.run.manifest.sources;
  manifest.counts = {{"faces", metrics.at("num_faces")}, {"persons", metrics.at("num_persons")}};
  manifest.details = {{"data", data.run.manifest.details.at("data")},
                      {"weights", Sha256OfFile(data.run.directory / "best" / "model.safetensors")}};
  for (const char* name : {"metrics.json", "table.md", "sheet.png", "mean_error.png", "errors.svg", "index.html"})
    manifest.checksums[name] = Sha256OfFile(folder / name);
  WriteManifest(folder, manifest);
}

}  // namespace

Json EvaluateSketchRun(const fs::path& run_directory, const std::string& split_side, const fs::path& out_directory,
                       double strength) {
  const auto start = std::chrono::steady_clock::now();
  const SketchRunData data = OpenSketchRunData(run_directory);
  SketchEvaluation evaluation(data, split_side, strength);
  evaluation.Measure();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const Json metrics = evaluation.Metrics(seconds);

  MakeDirectory(out_directory);
  WriteReport(out_directory, evaluation.Report(seconds));
  WriteFileAtomically(out_directory / "table.md", TableMarkdown(evaluation.rows()));
  WriteFileAtomically(out_directory / "metrics.json", metrics.dump(2) + "\n");
  WriteReportManifest(out_directory, data, metrics);
  return metrics;
}

}  // namespace daumier::eval
