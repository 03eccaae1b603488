#include "systems/portrait/train/portrait_evaluation.h"

#include "core/error.h"
#include "core/evenly_spaced.h"
#include "core/files.h"
#include "core/log.h"
#include "core/run_manifest.h"
#include "core/stopwatch.h"
#include "datasets/read/run_data.h"
#include "render/sheet.h"
#include "systems/portrait/landmark_errors.h"
#include "systems/portrait/landmark_files.h"
#include "systems/portrait/picture_files.h"
#include "systems/portrait/portrait_metrics.h"
#include "systems/portrait/train/picture_evaluation.h"
#include "systems/portrait/train/portrait_baselines.h"
#include "systems/portrait/train/portrait_prediction.h"
#include "systems/portrait/train/portrait_refinement.h"
#include "systems/portrait/train/portrait_run.h"
#include "tensor/array.h"

#include <algorithm>
#include <numeric>
#include <set>

namespace daumier::portrait {
namespace {

namespace fs = std::filesystem;

class PortraitEvaluation {
 public:
  PortraitEvaluation(const fs::path& run_directory, const PortraitEvalOptions& options, FolderCache& databases,
                     const Task& task)
      : options_(options),
        task_(task),
        run_(LoadPortraitRun(run_directory)),
        faces_(databases.Open<faces::FaceDatabase>(FindData("faces", options.data.faces))),
        portraits_(databases.Open<datasets::PortraitDatabase>(FindData("portraits", options.data.portraits))),
        loss_(run_.model, RefinementLoss()) {
    const datasets::Split split = datasets::SplitOfRun(run_.directory, run_.manifest, run_.config, faces_);
    images_ = EvenlySpaced(ImagesOfPersons(portraits_, PersonsOf(faces_, datasets::SubsetOf(split, options.split))),
                           options.max_images);
    CheckFolders({options.pictures, options.detected});
    if (images_.empty()) throw UsageError(fmt::format("the side '{}' of the split has no portrait", options.split));
    std::vector<PictureMap> maps;
    for (const int image : images_) maps.push_back(PlainCrop(portraits_, image, run_.options.pictures));
    measurement_.emplace(run_.model, portraits_, images_, maps, run_.manifest.seed);
  }

  void Measure() {
    const Stopwatch stopwatch;
    const PortraitGuesses guesses = Guess(*measurement_);
    measurement_->AddRow(kPortraitNetworkRow, guesses);
    if (options_.refined_images > 0) measurement_->AddRow(kRefinedRow, Refined(*measurement_, guesses, {}));
    if (options_.baselines) {
      std::vector<std::vector<float>> landmarks;
      for (const MeasuredPortrait& portrait : measurement_->portraits()) landmarks.push_back(portrait.landmarks);
      AddFits(*measurement_, landmarks, "");
    }
    guesses_ = guesses.coefficients;
    if (!options_.detected.empty()) MeasureDetected();
    if (!options_.pictures.empty()) pictures_ = EvaluatePictures(options_.pictures, options_.detected, run_);
    seconds_ = stopwatch.seconds();
  }

  reports::MetricTable Table() const {
    reports::MetricTable table = measurement_->table();
    for (const reports::MetricRow& row : detected_rows_) table.rows.push_back(row);
    table.data_hash = run_.manifest.details.at("data");
    return table;
  }

  Json Metrics() const {
    const reports::MetricTable table = Table();
    const reports::MetricRow& result = table.rows.front();
    const auto value = [&](const char* key) {
      const std::optional<double> number = reports::ValueOf(table, result, key);
      return number ? Json(*number) : Json();
    };
    return {{"system", kPortraitSystem},
            {"split", options_.split},
            {"num_images", images_.size()},
            {"num_persons", NumPersons()},
            {"vertex_error_mm", result.error().mean},
            {"landmark_error", value("landmark_error")},
            {"angle_error_degrees", value("angle_error")},
            {"photometric_error", value("photometric")},
            {"table", reports::TableJson(table)},
            {"pictures", pictures_ ? pictures_->metrics : Json()},
            {"data_hash", table.data_hash},
            {"seconds", seconds_},
            {"faces", table.faces},
            {"groups", table.groups},
            {"face_errors", result.face_errors}};
  }

  reports::ReportData Report() const {
    reports::ReportData report;
    report.title = fmt::format("Portraits to faces: {}, {} split", run_.model.face_template.source, options_.split);
    report.summary = fmt::format(
        "{} portraits of {} persons that were not trained on. Shape: mean distance of the face's vertices after the "
        "similarity that aligns them best; the face is 200 mm high from chin to hairline. Landmarks: mean distance, of "
        "that between the outer corners of the eyes. Colours: sum over RGB, of 3. The interval resamples persons.",
        images_.size(), NumPersons());
    report.tables = {reports::TextTable(Table())};
    if (pictures_) report.tables.push_back(pictures_->table);
    report.facts = {{"seed", fmt::format("{}", run_.manifest.seed)},
                    {"network", fmt::format("{} layers, width {}, {} pixels", run_.options.network.depth,
                                            run_.options.network.width, run_.options.network.resolution)},
                    {"seconds", fmt::format("{:.1f}", seconds_)}};
    for (const auto& [name, hash] : run_.manifest.details.at("data").items())
      report.facts.push_back({name + " (data hash)", hash.get<std::string>()});
    return report;
  }

  reports::Evaluation::Sheet Sheet() const {
    constexpr size_t kFirst = 6;
    const std::vector<double>& errors = measurement_->table().rows.front().face_errors;
    std::vector<size_t> order(errors.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return errors[a] < errors[b]; });
    std::vector<std::pair<std::string, size_t>> rows;
    for (size_t i = 0; i < std::min(kFirst, errors.size()); ++i) rows.push_back({fmt::format("number {}", i), i});
    rows.push_back({"median", order[order.size() / 2]});
    rows.push_back({"worst 5 %", order[size_t(double(order.size() - 1) * 0.95)]});
    rows.push_back({"worst", order.back()});
    std::vector<render::SheetCell> cells;
    for (const auto& [title, i] : rows) {
      const MeasuredPortrait& portrait = measurement_->portraits()[i];
      const FacePicture face = measurement_->painter().Paint(guesses_[i]);
      const render::Rgb predicted{255, 60, 60}, truth{40, 220, 80};
      cells.push_back({portrait.crop, fmt::format("{}: {:.2f} mm", title, errors[i])});
      cells.push_back({DotsOver(DotsOver(portrait.crop, portrait.landmarks, truth), face.landmarks, predicted),
                       fmt::format("landmarks {:.1f} %", 100 * NormalisedError(face.landmarks, portrait.landmarks))});
      cells.push_back({OverlayFace(portrait.crop, face), "overlay"});
      cells.push_back({OverlayFace(portrait.crop, face, 0.5), "half"});
    }
    return {render::MakeSheet(cells, 4),
            "Crops, landmarks (true green, predicted red), the predicted face over the crop, and half transparent."};
  }

  std::vector<reports::Evaluation::Picture> Pictures() const {
    if (!pictures_) return {};
    const std::string shows = "Crop, landmarks (given green, predicted red) and the predicted face over the crop of ";
    return {
        {"Pictures without known faces", "pictures.jpg", {pictures_->chosen, shows + "chosen pictures, one a row."}},
        {"All pictures without known faces", "all_pictures.jpg", {pictures_->all, shows + "each, two a row."}}};
  }

  Manifest ReportManifest() const {
    Manifest manifest{.kind = "report", .verb = "eval"};
    manifest.config = ToJson(options_);
    for (const char* folder : {"data", "pictures", "detected"}) manifest.config.erase(folder);
    manifest.seed = run_.manifest.seed;
    manifest.sources = run_.manifest.sources;
    manifest.counts = {{"portraits", images_.size()}, {"persons", NumPersons()}};
    manifest.details = {{"system", kPortraitSystem},
                        {"data", run_.manifest.details.at("data")},
                        {"weights", Sha256OfFile(BestWeights(run_.directory))}};
    return manifest;
  }

 private:
  fs::path FindData(const char* kind, const std::string& moved) const {
    return datasets::FindRunData(run_.directory, run_.manifest, run_.config, kind, moved);
  }

  /// What a refinement minimises: eq. 3, with the openings, whatever the run was trained by.
  static PortraitLossOptions RefinementLoss() {
    PortraitLossOptions loss;
    loss.openings = 0.02;
    return loss;
  }

  /// Inputs of the network, (n, 3, R, R).
  torch::Tensor Inputs(const CropMeasurement& measurement) const {
    const int64_t r = run_.options.network.resolution;
    FloatArray inputs({int64_t(measurement.portraits().size()), 3, r, r});
    for (size_t i = 0; i < measurement.portraits().size(); ++i) {
      const std::vector<float> planes = NetworkPicture(measurement.portraits()[i].crop, int(r));
      std::copy(planes.begin(), planes.end(), inputs.row(int64_t(i)));
    }
    return tensor::TakeTensor(std::move(inputs));
  }

  PortraitGuesses Guess(const CropMeasurement& measurement) {
    const torch::Tensor inputs = Inputs(measurement);
    const torch::Tensor x = PredictPortraits(run_.network, loss_.renderer(), inputs).coefficients.contiguous();
    const Stopwatch stopwatch;
    constexpr int64_t kTimed = 20;
    for (int64_t i = 0; i < kTimed; ++i)
      PredictPortraits(run_.network, loss_.renderer(), inputs.slice(0, i % inputs.size(0), i % inputs.size(0) + 1));
    PortraitGuesses guesses{{}, 1000 * stopwatch.seconds() / kTimed};
    for (int64_t i = 0; i < x.size(0); ++i)
      guesses.coefficients.emplace_back(x[i].data_ptr<float>(), x[i].data_ptr<float>() + faces::kNumCoefficients);
    return guesses;
  }

  /// The first guesses, refined. landmarks: of each portrait in its crop; empty: the true ones.
  PortraitGuesses Refined(const CropMeasurement& measurement, const PortraitGuesses& guesses,
                          const std::vector<std::vector<float>>& landmarks) {
    PortraitGuesses refined;
    const size_t count = std::min(size_t(options_.refined_images), measurement.portraits().size());
    const Stopwatch stopwatch;
    for (size_t i = 0; i < count; ++i) {
      task_.ThrowIfCancelled("stopped after {} of {} refinements", i, count);
      const MeasuredPortrait& portrait = measurement.portraits()[i];
      std::vector<float> colours = ColourPlanes(portrait.crop), shown = portrait.shown,
                         of_landmarks = landmarks.empty() ? portrait.landmarks : landmarks[i],
                         guess = guesses.coefficients[i];
      train::Batch batch;
      const auto add = [&](const char* name, std::vector<float>& numbers, std::vector<int64_t> shape) {
        batch.tensors[name] = torch::from_blob(numbers.data(), shape, torch::kFloat32).clone();
      };
      add("picture", colours, {1, 3, kPortraitSide, kPortraitSide});
      add("skin", shown, {1, 1, kPortraitSide, kPortraitSide});
      add("landmarks", of_landmarks, {1, 68, 2});
      batch.tensors["landmark_weights"] = losses_weights_;
      const torch::Tensor x =
          RefinePortrait(loss_, torch::from_blob(guess.data(), {1, faces::kNumCoefficients}, torch::kFloat32), batch,
                         run_.model.expression_weights, {.steps = options_.refinement_steps})
              .contiguous();
      refined.coefficients.emplace_back(x.data_ptr<float>(), x.data_ptr<float>() + faces::kNumCoefficients);
    }
    refined.ms = 1000 * stopwatch.seconds() / double(count);
    return refined;
  }

  void AddFits(CropMeasurement& measurement, const std::vector<std::vector<float>>& landmarks,
               const std::string& suffix) const {
    measurement.AddRow(kMeanFaceRow + suffix, FitAll(run_.model, landmarks, fitting::PortraitFreedom::kPose), true);
    measurement.AddRow(kLandmarkFitRow + suffix, FitAll(run_.model, landmarks, fitting::PortraitFreedom::kPoseAndFace),
                       true);
  }

  /// The same rows with landmarks of a detector in place of the true ones. Without a detection the crop is the picture.
  void MeasureDetected() {
    std::vector<PictureMap> maps;
    std::vector<std::vector<float>> landmarks;
    size_t missing = 0;
    for (const int image : images_) {
      auto found = LandmarksInFolder(options_.detected, fmt::format("{}", image));
      if (!found) {
        ++missing;
        maps.push_back(CropOfWhole(portraits_.image_size(), portraits_.image_size()));
        const PortraitRenderer& renderer = loss_.renderer();
        torch::Tensor x = models::CoefficientsOf(torch::zeros({1, faces::kNumCoefficients}),
                                                 run_.network->expression_weights(), run_.network->usual_pose());
        const torch::Tensor points = renderer.Landmarks(x).contiguous();
        landmarks.emplace_back(points.data_ptr<float>(), points.data_ptr<float>() + 136);
        continue;
      }
      maps.push_back(CropOfLandmarks(*found, run_.options.pictures.size));
      landmarks.push_back(MapLandmarks(*found, maps.back()));
    }
    if (missing > 0) log::Warn("{} of {} portraits have no detected landmarks", missing, images_.size());
    CropMeasurement measurement(run_.model, portraits_, images_, maps, run_.manifest.seed);
    const PortraitGuesses guesses = Guess(measurement);
    measurement.AddRow("network, detected landmarks", guesses);
    if (options_.refined_images > 0)
      measurement.AddRow("network, refined, detected landmarks", Refined(measurement, guesses, landmarks));
    if (options_.baselines) AddFits(measurement, landmarks, ", detected landmarks");
    detected_rows_ = measurement.table().rows;
  }

  int NumPersons() const {
    const std::vector<int>& groups = measurement_->table().groups;
    return int(std::set<int>(groups.begin(), groups.end()).size());
  }

  const PortraitEvalOptions options_;
  const Task task_;
  PortraitRun run_;
  const faces::FaceDatabase& faces_;
  const datasets::PortraitDatabase& portraits_;
  const PortraitLoss loss_;
  const torch::Tensor losses_weights_ = torch::ones({1, 68});
  std::vector<int> images_;
  std::optional<CropMeasurement> measurement_;
  std::vector<std::vector<float>> guesses_;
  std::vector<reports::MetricRow> detected_rows_;
  std::optional<PictureEvaluation> pictures_;
  double seconds_ = 0;
};

}  // namespace

reports::Evaluation EvaluatePortraitRun(const fs::path& run_directory, const PortraitEvalOptions& options,
                                        FolderCache& databases, const Task& task) {
  PortraitEvaluation evaluation(run_directory, options, databases, task);
  evaluation.Measure();
  return {.table = evaluation.Table(),
          .metrics = evaluation.Metrics(),
          .report = evaluation.Report(),
          .sheet = evaluation.Sheet(),
          .manifest = evaluation.ReportManifest(),
          .pictures = evaluation.Pictures()};
}

}  // namespace daumier::portrait
