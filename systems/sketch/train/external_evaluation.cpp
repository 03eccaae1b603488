#include "systems/sketch/train/external_evaluation.h"

#include "core/error.h"
#include "core/files.h"
#include "core/log.h"
#include "core/manifest.h"
#include "core/parallel.h"
#include "datasets/read/sketch_variation.h"
#include "reports/face_pictures.h"
#include "eval/metrics.h"
#include "eval/nearest_neighbour.h"
#include "eval/ridge_regression.h"
#include "systems/sketch/train/run_data.h"
#include "faces/bilinear_projector.h"
#include "faces/face_database.h"
#include "fitting/contour_refinement.h"
#include "export/torch_runner.h"
#include "systems/sketch/predictor.h"
#include "systems/sketch/train/export.h"
#include "fitting/stroke_deformation.h"
#include "fitting/stroke_distance.h"
#include "geometry/coordinates.h"
#include "render/sheet.h"
#include "render/stroke_overlay.h"

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

/// Faces that are predicted at once.
constexpr size_t kBlock = 64;

struct Row {
  std::string name;
  std::vector<double> errors_mm;   ///< One a face; empty for another topology.
  std::vector<double> matched_mm;  ///< The same where the registered mesh is; empty where faces were not registered.
  std::vector<double> errors_px;
};

class OtherFaces {
 public:
  OtherFaces(const fs::path& run, const OtherFacesOptions& options)
      : predictor_(ReadSketchRunFolder(run),
                   std::make_shared<exporting::TorchRunner>(DescribeSketchExport(run), torch::kCPU), {.deform = true}),
        faces_(options.faces),
        sketches_(options.sketches),
        seed_(predictor_.run().manifest.seed) {
    DAUMIER_CHECK(sketches_.manifest().details.value("faces_data_hash", "") == DataHash(options.faces),
                  "{} are sketches of other faces than {}: make them again with `daumier dataset sketches`",
                  options.sketches, options.faces);
    variation_.augmentation.strength = options.strength;
    const auto& own = predictor_.run().face_template.triangles;
    const auto& other = faces_.face_template().triangles;
    same_topology_ = own.rows() == other.rows() && own == other;
    for (int face = 0; face < faces_.num_faces(); ++face) groups_.push_back(faces_.group(face));
    registered_ = same_topology_ && !faces_.match_distances(0).empty();
  }

  void Measure() {
    const faces::BilinearModel& bilinear = predictor_.run().models.bilinear;
    const Eigen::VectorXf u = bilinear.identity_factors.colwise().mean(),
                          v = bilinear.expression_factors.colwise().mean();
    const Eigen::VectorXf mean = faces::Reconstruct(bilinear, u, v);
    PredictedFace mean_face{u, v, {mean.begin(), mean.end()}};
    AddRow("mean face", [&](int) { return mean_face; });
    log::Info("Predicting {} faces by the network", faces_.num_faces());
    Predict();
    Refine();
    AddRow("network", [&](int face) { return predicted_[size_t(face)]; });
    AddRow("network, refined", [&](int face) { return refined_[size_t(face)]; });
    AddRow("network, deformed", [&](int face) { return Deformed(refined_[size_t(face)], face); });
    AddRow("mean face, deformed", [&](int face) { return Deformed(mean_face, face); });
    if (!same_topology_) return;
    Eigen::VectorXf weights = Eigen::VectorXf::Zero(bilinear.num_coordinates());
    for (const int vertex : region()) weights.segment<3>(3 * vertex).setOnes();
    const faces::BilinearProjector projector(bilinear, weights);
    AddRow("limit of the model", [&](int face) {
      const auto projection = projector.Project(faces_.vertices(face));
      return PredictedFace{projection.u, projection.v, {projection.vertices.begin(), projection.vertices.end()}};
    });
  }

  /// Fitted on the faces that the run was trained on.
  void MeasureBaselines() {
    if (!same_topology_ || variation_.augmentation.strength > 0) return;
    const std::optional<SketchRunData> own = OwnData();
    if (!own) return;
    log::Info("Fitting the free baselines on {} training faces", own->split.train.size());
    const eval::SketchSamples samples{[&](int face) { return own->faces.vertices(face); },
                                [&](int face) { return own->sketches.curve_points(face); }};
    const eval::NearestNeighbour nearest(eval::ReadRows(samples.curve_points, own->split.train));
    AddRow("nearest neighbour", [&](int face) {
      const auto vertices = samples.vertices(own->split.train[size_t(nearest.Nearest(sketches_.curve_points(face)))]);
      return PredictedFace{{}, {}, {vertices.begin(), vertices.end()}};
    });
    const eval::RidgeFit ridge = eval::FitRidge(samples, own->split.train, own->split.validation, region(), eval::DefaultRidgeLambdas());
    AddRow("ridge regression", [&](int face) {
      const std::vector<float> points = sketches_.curve_points(face);
      const eval::FaceRows answer =
          ridge.model.Predict(Eigen::Map<const eval::FaceRows>(points.data(), 1, Eigen::Index(points.size())));
      return PredictedFace{{}, {}, {answer.data(), answer.data() + answer.size()}};
    });
  }

  Json Table() const {
    Json table = Json::array();
    for (const Row& row : rows_) {
      Json line{{"name", row.name}, {"curve_error_px", eval::Mean(row.errors_px)}};
      AddErrors(row.errors_mm, "error", line);
      line["p90"] = row.errors_mm.empty() ? Json() : Json(eval::Percentile(row.errors_mm, 90));
      if (registered_) AddErrors(row.matched_mm, "matched_error", line);
      table.push_back(line);
    }
    return table;
  }

  /// The median, the worst 5 % (where they begin, and the worst) and the first by index.
  render::Image Sheet() const {
    const Row& network = rows_[1];
    const std::vector<double>& errors = same_topology_ ? network.errors_mm : network.errors_px;
    std::vector<int> order(errors.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return errors[size_t(a)] < errors[size_t(b)]; });
    const size_t last = order.size() - 1;
    const std::vector<std::pair<std::string, int>> chosen{
        {"median", order[last / 2]},
        {"95th percentile", order[size_t(std::ceil(0.95 * double(last)))]},
        {"worst", order[last]},
        {"first", 0}};
    render::SheetStyle style{.column_titles = {"sketch, curves of the deformed face", "true face", "network",
                                               "network, deformed", "network, deformed"}};
    std::vector<render::SheetCell> cells;
    for (const auto& [what, face] : chosen) {
      style.row_titles.push_back(
          fmt::format("{}: {:.2f} {}", what, errors[size_t(face)], same_topology_ ? "mm" : "px"));
      const PredictedFace deformed = Deformed(refined_[size_t(face)], face);
      const geometry::Points network = geometry::PointsFrom(predicted_[size_t(face)].vertices),
                             moved = geometry::PointsFrom(deformed.vertices);
      const faces::FaceTemplate& own = predictor_.run().face_template;
      cells.push_back({render::DrawnWithCurves(Seen(face).strokes, predictor_.CurvesOf(deformed), reports::kCell)});
      cells.push_back({reports::FrontView(faces_.face_template(), faces_.points(face), render::FrameOf(faces_.points(face)))});
      cells.push_back({reports::FrontView(own, network, render::FrameOf(network))});
      cells.push_back({reports::FrontView(own, moved, render::FrameOf(moved))});
      cells.push_back({reports::SideView(own, moved, render::FrameOf(moved))});
    }
    return render::MakeSheet(cells, 5, style);
  }

  bool same_topology() const { return same_topology_; }
  const faces::FaceDatabase& faces() const { return faces_; }
  const SketchRunFolder& run() const { return predictor_.run(); }

 private:
  /// None where they have moved.
  std::optional<SketchRunData> OwnData() const {
    try {
      return OpenSketchRunData(predictor_.run().directory);
    } catch (const Error& error) {
      log::Info("Without ridge regression and nearest neighbour, which read the training faces: {}", error.what());
      return std::nullopt;
    }
  }

  /// KEY, KEY_low and KEY_high; null where there are no errors.
  void AddErrors(const std::vector<double>& errors, const std::string& key, Json& line) const {
    if (errors.empty()) {
      line[key] = line[key + "_low"] = line[key + "_high"] = Json();
      return;
    }
    const eval::Interval interval = eval::PersonBootstrap(errors, groups_, seed_);
    line[key] = eval::Mean(errors);
    line[key + "_low"] = interval.low;
    line[key + "_high"] = interval.high;
  }

  const std::vector<int>& region() const { return faces_.face_template().annotation.regions.at("face"); }

  /// Vertices of the region that have a match on the mesh that the face was registered onto.
  std::vector<int> MatchedRegion(int face) const {
    const std::span<const float> distances = faces_.match_distances(face);
    std::vector<int> matched;
    std::copy_if(region().begin(), region().end(), std::back_inserter(matched),
                 [&](int vertex) { return !std::isnan(distances[size_t(vertex)]); });
    return matched;
  }

  datasets::AugmentedSketch Seen(int face) const {
    return datasets::VariedSketch(sketches_, face, variation_, seed_, 0);
  }

  /// The silhouette and feature lines as they are drawn: of strokes that came in, the pieces that are shown.
  Strokes DrawnFeatures(int face) const {
    Strokes features;
    for (const render::Stroke& stroke : Seen(face).strokes) {
      if (!datasets::IsWrinkleKind(sketches_.kinds()[size_t(stroke.kind)])) features.push_back(stroke);
    }
    return features;
  }

  PredictedFace Deformed(PredictedFace start, int face) const {
    return predictor_.Deformed(std::move(start), Seen(face).strokes);
  }

  void Predict() {
    for (int begin = 0; begin < faces_.num_faces(); begin += int(kBlock)) {
      std::vector<Strokes> block;
      for (int face = begin; face < std::min(begin + int(kBlock), faces_.num_faces()); ++face)
        block.push_back(Seen(face).strokes);
      for (PredictedFace& face : predictor_.FromStrokes(block)) predicted_.push_back(std::move(face));
    }
  }

  void Refine() {
    ForEachInOrder(
        faces_.num_faces(), [&](int face) { return predictor_.Refined(predicted_[size_t(face)], Seen(face).strokes); },
        [&](PredictedFace face) { refined_.push_back(std::move(face)); });
  }

  void AddRow(const std::string& name, const std::function<PredictedFace(int face)>& answer) {
    struct Errors {
      double mm, matched_mm, px;
    };
    Row row{name, {}, {}, {}};
    const double mm_per_cm = faces::MillimetresPerCm(faces_.face_template());
    ForEachInOrder(
        faces_.num_faces(),
        [&](int face) {
          const PredictedFace answered = answer(face);
          const auto error = [&](const std::vector<int>& vertices) {
            return eval::MeanVertexError(answered.vertices, faces_.vertices(face), vertices, mm_per_cm);
          };
          return Errors{same_topology_ ? error(region()) : 0, registered_ ? error(MatchedRegion(face)) : 0,
                        fitting::DistanceBetween(DrawnFeatures(face), predictor_.CurvesOf(answered)).two_way()};
        },
        [&](const Errors& errors) {
          if (same_topology_) row.errors_mm.push_back(errors.mm);
          if (registered_) row.matched_mm.push_back(errors.matched_mm);
          row.errors_px.push_back(errors.px);
        });
    rows_.push_back(std::move(row));
  }

  SketchPredictor predictor_;
  const faces::FaceDatabase faces_;
  const datasets::SketchDatabase sketches_;
  const uint64_t seed_;
  datasets::SketchVariation variation_;
  bool same_topology_ = false;
  bool registered_ = false;  ///< And of the run's own topology.
  std::vector<int> groups_;
  std::vector<PredictedFace> predicted_, refined_;
  std::vector<Row> rows_;
};

std::string TableText(const Json& table) {
  const bool registered = table.front().contains("matched_error");
  std::string text =
      fmt::format("| predictor | mm | 95 % interval | p90 |{} curves, px |\n|---|---:|---:|---:|{}---:|\n",
                  registered ? " mm where the mesh is | 95 % interval |" : "", registered ? "---:|---:|" : "");
  for (const Json& row : table) {
    const auto number = [&](const std::string& key) {
      return row.at(key).is_null() ? "-" : fmt::format("{:.3f}", row.at(key).get<double>());
    };
    const auto with_interval = [&](const std::string& key) {
      if (row.at(key).is_null()) return std::string("- | -");
      return fmt::format("{} | {} to {}", number(key), number(key + "_low"), number(key + "_high"));
    };
    text += fmt::format("| {} | {} | {} |{} {} |\n", row.at("name").get<std::string>(), with_interval("error"),
                        number("p90"), registered ? fmt::format(" {} |", with_interval("matched_error")) : "",
                        number("curve_error_px"));
  }
  return text;
}

}  // namespace

Json EvaluateOnOtherFaces(const fs::path& run_directory, const fs::path& out_directory,
                          const OtherFacesOptions& options) {
  OtherFaces other(run_directory, options);
  other.Measure();
  if (options.baselines) other.MeasureBaselines();
  const Json hashes = {{"faces", DataHash(options.faces)}, {"sketches", DataHash(options.sketches)}};
  Json metrics = {{"num_faces", other.faces().num_faces()},
                  {"same_topology", other.same_topology()},
                  {"augmentation_strength", options.strength},
                  {"table", other.Table()},
                  {"data_hash", hashes},
                  {"run_data_hash", DataHash(run_directory)}};
  MakeDirectory(out_directory);
  WriteFileAtomically(out_directory / "metrics.json", metrics.dump(2) + "\n");
  WriteFileAtomically(out_directory / "table.md", TableText(metrics.at("table")));
  render::WriteImage(out_directory / "sheet.png", other.Sheet());
  Manifest manifest;
  manifest.kind = "report";
  manifest.verb = "eval";
  manifest.config = {{"strength", options.strength}};
  manifest.seed = other.run().manifest.seed;
  manifest.sources = other.run().manifest.sources;
  for (const Json& source : other.faces().manifest().sources) manifest.sources.push_back(source);
  manifest.counts = {{"faces", other.faces().num_faces()}};
  manifest.details = {{"data", hashes}, {"run_data_hash", DataHash(run_directory)}};
  for (const char* name : {"metrics.json", "table.md", "sheet.png"})
    manifest.checksums[name] = Sha256OfFile(out_directory / name);
  WriteManifest(out_directory, manifest);
  return metrics;
}

}  // namespace daumier::sketch
