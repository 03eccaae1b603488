#include "systems/sketch/train/external_evaluation.h"

#include "core/error.h"
#include "core/log.h"
#include "core/manifest.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "datasets/read/sketch_variation.h"
#include "eval/metrics.h"
#include "eval/nearest_neighbour.h"
#include "eval/ridge_regression.h"
#include "export/torch_runner.h"
#include "faces/bilinear_projector.h"
#include "faces/face_database.h"
#include "fitting/contour_refinement.h"
#include "fitting/stroke_distance.h"
#include "geometry/coordinates.h"
#include "render/sheet.h"
#include "render/stroke_overlay.h"
#include "reports/chosen_faces.h"
#include "reports/face_pictures.h"
#include "systems/sketch/metrics.h"
#include "systems/sketch/parser_predictor.h"
#include "systems/sketch/predictor.h"
#include "systems/sketch/train/export.h"
#include "systems/sketch/train/parser_export.h"
#include "systems/sketch/train/reader.h"
#include "systems/sketch/train/run_data.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>
#include <optional>

namespace daumier::sketch {
namespace {

namespace fs = std::filesystem;
using fitting::PredictedFace;
using Strokes = std::vector<render::Stroke>;

constexpr const char* kPixels = "curve_error_px";

std::vector<reports::Metric> Columns(bool registered) {
  using reports::ShowInterval;
  std::vector<reports::Metric> columns = {
      {.key = "error", .title = "mm", .unit = "mm", .interval = ShowInterval::kInColumn},
      {.key = "p90", .title = "p90", .of_key = "error", .percentile = 90}};
  if (registered)
    columns.push_back(
        {.key = "matched_error", .title = "mm where the mesh is", .unit = "mm", .interval = ShowInterval::kInColumn});
  columns.push_back({.key = kPixels, .title = "curves, px"});
  return columns;
}

class ExternalEvaluation {
 public:
  ExternalEvaluation(const fs::path& run, const SketchEvalOptions& options, FolderCache& databases, const Task& task)
      : databases_(databases),
        own_data_(options.data),
        task_(task),
        predictor_(
            ReadSketchRunFolder(run),
            std::make_shared<exporting::TorchRunner>(exporting::NetworkOf(DescribeSketchExport(run)), torch::kCPU),
            nullptr, {.framing = "keep"}),
        fitter_(predictor_.run(), std::make_shared<const DrawingParser>(OpenParserOfRun(ParserFolder(options.parser)))),
        faces_(databases.Open<faces::FaceDatabase>(options.faces)),
        sketches_(databases.Open<datasets::SketchDatabase>(options.sketches)),
        seed_(predictor_.run().manifest.seed) {
    DAUMIER_CHECK(sketches_.manifest().details.value("faces_data_hash", "") == DataHash(options.faces),
                  "{} are sketches of other faces than {}: make them again with `daumier dataset sketches`",
                  options.sketches, options.faces);
    variation_.augmentation.strength = options.strength;
    const auto& own = predictor_.run().face_template.triangles;
    const auto& other = faces_.face_template().triangles;
    same_topology_ = own.rows() == other.rows() && own == other;
    registered_ = same_topology_ && !faces_.match_distances(0).empty();
    table_.columns = Columns(registered_);
    for (int face = 0; face < faces_.num_faces(); ++face) {
      table_.faces.push_back(face);
      table_.groups.push_back(faces_.group(face));
    }
    table_.data_hash = {{"faces", DataHash(options.faces)}, {"sketches", DataHash(options.sketches)}};
  }

  void Measure() {
    const faces::BilinearModel& bilinear = predictor_.run().models.bilinear;
    const Eigen::VectorXf u = bilinear.identity_factors.colwise().mean(),
                          v = bilinear.expression_factors.colwise().mean();
    const Eigen::VectorXf mean = faces::Reconstruct(bilinear, u, v);
    PredictedFace mean_face{u, v, {mean.begin(), mean.end()}};
    AddRow(kMeanFace, [&](int) { return mean_face; });
    table_.rows.back().baseline = true;
    log::Info("Predicting {} faces by the network", faces_.num_faces());
    Predict();
    Refine();
    table_.result = table_.rows.size();
    AddRow("network", [&](int face) { return predicted_[size_t(face)]; });
    AddRow("network, refined", [&](int face) { return refined_[size_t(face)]; });
    AddPlacedRow("network, fitted", [&](int face) { return Fitted(refined_[size_t(face)], face); });
    AddPlacedRow("mean face, fitted", [&](int face) { return Fitted(mean_face, face); });
    if (!same_topology_) return;
    Eigen::VectorXf weights = Eigen::VectorXf::Zero(bilinear.num_coordinates());
    for (const int vertex : region()) weights.segment<3>(3 * vertex).setOnes();
    const faces::BilinearProjector projector(bilinear, weights);
    AddRow(kModelLimit, [&](int face) {
      const auto projection = projector.Project(faces_.vertices(face));
      return PredictedFace{projection.u, projection.v, {projection.vertices.begin(), projection.vertices.end()}};
    });
  }

  /// Fitted on the faces that the run was trained on.
  void MeasureBaselines() {
    // The baselines read labelled curves, which drawings by hand lack.
    if (!same_topology_ || variation_.augmentation.strength > 0 || sketches_.num_drawn_views() > 0) return;
    const std::optional<SketchRunData> own = OwnData();
    if (!own) return;
    log::Info("Fitting the training-free baselines on {} training faces", own->split.train.size());
    const eval::SketchSamples samples{[&](int face) { return own->faces.vertices(face); },
                                      [&](int face) { return own->sketches.curve_points(face); }};
    const eval::NearestNeighbour nearest(eval::ReadRows(samples.curve_points, own->split.train));
    AddRow(kNearestNeighbour, [&](int face) {
      const auto vertices = samples.vertices(own->split.train[size_t(nearest.Nearest(sketches_.curve_points(face)))]);
      return PredictedFace{{}, {}, {vertices.begin(), vertices.end()}};
    });
    const eval::RidgeFit ridge =
        eval::FitRidge(samples, own->split.train, own->split.validation, region(), eval::DefaultRidgeLambdas());
    AddRow(kRidge, [&](int face) {
      const std::vector<float> points = sketches_.curve_points(face);
      const eval::FaceRows predicted =
          ridge.model.Predict(Eigen::Map<const eval::FaceRows>(points.data(), 1, Eigen::Index(points.size())));
      return PredictedFace{{}, {}, {predicted.data(), predicted.data() + predicted.size()}};
    });
  }

  /// Faces of reports::ChooseFaces by the network's errors.
  render::Image Sheet() const {
    const std::vector<double>& errors = same_topology_ ? table_.rows[table_.result].face_errors : network_px_;
    render::SheetStyle style{.column_titles = {"sketch, curves of the fitted face", "true face", "network",
                                               "network, fitted", "network, fitted"}};
    std::vector<render::SheetCell> cells;
    const faces::FinishedHead true_head(faces_.face_template()), own_head(predictor_.run().face_template);
    for (const auto& [title, face] : reports::ChooseFaces(table_.faces, errors)) {
      style.row_titles.push_back(
          fmt::format("{}: {:.2f} {}", title, errors[size_t(face)], same_topology_ ? "mm" : "px"));
      const PlacedFace fitted = Fitted(refined_[size_t(face)], face);
      const geometry::Points network = geometry::PointsFrom(predicted_[size_t(face)].vertices),
                             moved = geometry::PointsFrom(fitted.face.vertices);
      cells.push_back({render::DrawnWithCurves(render::MapToCanvas(SketchOf(face).strokes, fitted.frame),
                                               predictor_.CurvesOf(fitted.face), reports::kCell)});
      cells.push_back({reports::FrontView(true_head, faces_.points(face), render::FrameOf(faces_.points(face)))});
      cells.push_back({reports::FrontView(own_head, network, render::FrameOf(network))});
      cells.push_back({reports::FrontView(own_head, moved, render::FrameOf(moved))});
      cells.push_back({reports::SideView(own_head, moved, render::FrameOf(moved))});
    }
    return render::MakeSheet(cells, 5, style);
  }

  const reports::MetricTable& table() const { return table_; }
  bool same_topology() const { return same_topology_; }
  const faces::FaceDatabase& faces() const { return faces_; }
  const SketchRunFolder& run() const { return predictor_.run(); }

 private:
  /// Absent if they have moved.
  std::optional<SketchRunData> OwnData() const {
    try {
      return OpenSketchRunData(predictor_.run().directory, databases_, own_data_);
    } catch (const Error& error) {
      log::Info("Without ridge regression and nearest neighbour, which read the training faces: {}", error.what());
      return std::nullopt;
    }
  }

  const std::vector<int>& region() const {
    return faces::RegionFor(faces_.face_template().annotation, "face", "measuring errors");
  }

  /// Vertices of the region that have a match on the mesh that the face was registered onto.
  std::vector<int> MatchedRegion(int face) const {
    const std::span<const float> distances = faces_.match_distances(face);
    std::vector<int> matched;
    std::copy_if(region().begin(), region().end(), std::back_inserter(matched),
                 [&](int vertex) { return !std::isnan(distances[size_t(vertex)]); });
    return matched;
  }

  datasets::AugmentedSketch SketchOf(int face) const {
    return datasets::VariedSketch(sketches_, face, variation_, seed_, 0);
  }

  /// The visible pieces of silhouette and feature lines.
  Strokes DrawnFeatures(int face) const {
    Strokes features;
    for (const render::Stroke& stroke : SketchOf(face).strokes) {
      if (!datasets::IsWrinkleKind(sketches_.kinds()[size_t(stroke.kind)])) features.push_back(stroke);
    }
    return features;
  }

  /// A face, and the frame of its sketch.
  struct PlacedFace {
    PredictedFace face;
    render::Placement frame = {};  ///< Sketch to canvas.
  };
  PlacedFace Fitted(PredictedFace start, int face) const {
    FittedFace fitted = fitter_.FittedTo(SketchOf(face).strokes, start.vertices);
    start.vertices = std::move(fitted.vertices);
    return {std::move(start), fitted.frame};
  }

  void Predict() {
    for (int begin = 0; begin < faces_.num_faces(); begin += int(kBlock)) {
      std::vector<Strokes> block;
      for (int face = begin; face < std::min(begin + int(kBlock), faces_.num_faces()); ++face)
        block.push_back(SketchOf(face).strokes);
      for (PredictedFace& face : predictor_.FromStrokes(block)) predicted_.push_back(std::move(face));
    }
  }

  void Refine() {
    ForEachInOrder(
        faces_.num_faces(),
        [&](int face) { return predictor_.Refined(predicted_[size_t(face)], SketchOf(face).strokes); },
        [&](PredictedFace face) { refined_.push_back(std::move(face)); });
  }

  void AddRow(const std::string& name, const std::function<PredictedFace(int face)>& predict) {
    AddPlacedRow(name, [&](int face) { return PlacedFace{predict(face)}; });
  }

  void AddPlacedRow(const std::string& name, const std::function<PlacedFace(int face)>& predict) {
    struct Errors {
      double mm, matched_mm, px;
    };
    reports::FaceValues values;
    const double mm_per_cm = faces::MillimetresPerCm(faces_.face_template());
    Progress progress(task_.Stage(name), faces_.num_faces(), "faces");
    ForEachInOrder(
        faces_.num_faces(),
        [&](int face) {
          task_.ThrowIfCancelled("the evaluation was stopped; nothing was written");
          const auto& [predicted, frame] = predict(face);
          const auto error = [&](const std::vector<int>& vertices) {
            return eval::MeanVertexError(predicted.vertices, faces_.vertices(face), vertices, mm_per_cm);
          };
          return Errors{
              same_topology_ ? error(region()) : 0, registered_ ? error(MatchedRegion(face)) : 0,
              fitting::DistanceBetween(render::MapToCanvas(DrawnFeatures(face), frame), predictor_.CurvesOf(predicted))
                      .two_way() /
                  frame.scale};
        },
        [&](const Errors& errors) {
          if (same_topology_) values["error"].push_back(errors.mm);
          if (registered_) values["matched_error"].push_back(errors.matched_mm);
          values[kPixels].push_back(errors.px);
          progress.Step();
        });
    if (table_.rows.size() == table_.result) network_px_ = values.at(kPixels);
    table_.rows.push_back(reports::MakeRow(table_, name, values, seed_));
  }

  FolderCache& databases_;
  const SketchEvalData own_data_;
  const Task task_;
  SketchPredictor predictor_;
  DrawingFitter fitter_;
  const faces::FaceDatabase& faces_;
  const datasets::SketchDatabase& sketches_;
  const uint64_t seed_;
  datasets::SketchVariation variation_;
  bool same_topology_ = false;
  bool registered_ = false;  ///< And of the run's own topology.
  std::vector<PredictedFace> predicted_, refined_;
  reports::MetricTable table_;
  std::vector<double> network_px_;  ///< Of each face.
};

}  // namespace

reports::Evaluation EvaluateOnExternalFaces(const fs::path& run_directory, const SketchEvalOptions& options,
                                            FolderCache& databases, const Task& task) {
  ExternalEvaluation external(run_directory, options, databases, task);
  external.Measure();
  if (options.baselines) external.MeasureBaselines();
  const reports::MetricTable& table = external.table();
  const std::string run_hash = DataHash(run_directory);
  reports::Evaluation evaluation{.table = table};
  evaluation.metrics = {{"num_faces", table.faces.size()},
                        {"same_topology", external.same_topology()},
                        {"augmentation_strength", options.strength},
                        {"table", reports::TableJson(table)},
                        {"data_hash", table.data_hash},
                        {"run_data_hash", run_hash}};
  evaluation.report.title = fmt::format("Sketch to face: {} on other faces", external.run().face_template.source);
  evaluation.report.summary = fmt::format(
      "{} faces that the run was not trained on. Millimetres over the face region, where the face from chin "
      "to hairline is 200 mm high; nothing is aligned before measuring. The interval resamples persons.",
      table.faces.size());
  evaluation.report.tables = {reports::TextTable(table)};
  evaluation.report.facts = {{"faces (data hash)", table.data_hash.at("faces").get<std::string>()},
                             {"sketches (data hash)", table.data_hash.at("sketches").get<std::string>()},
                             {"run (data hash)", run_hash}};
  evaluation.sheet = {external.Sheet(),
                      "Each row: the sketch with the curves of the fitted face, the true face, the network's face, "
                      "and the fitted one from the front and the side."};
  Manifest& manifest = evaluation.manifest;
  manifest.kind = "report";
  manifest.verb = "eval";
  manifest.config = {{"strength", options.strength}};
  manifest.seed = external.run().manifest.seed;
  manifest.sources = external.run().manifest.sources;
  for (const Json& source : external.faces().manifest().sources) manifest.sources.push_back(source);
  manifest.counts = {{"faces", table.faces.size()}};
  manifest.details = {{"data", table.data_hash}, {"run_data_hash", run_hash}};
  return evaluation;
}

}  // namespace daumier::sketch
