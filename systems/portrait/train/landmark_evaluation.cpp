#include "systems/portrait/train/landmark_evaluation.h"

#include "core/error.h"
#include "core/evenly_spaced.h"
#include "core/files.h"
#include "core/progress.h"
#include "core/run_manifest.h"
#include "core/stopwatch.h"
#include "datasets/read/run_data.h"
#include "export/torch_runner.h"
#include "render/sheet.h"
#include "systems/portrait/landmark_metrics.h"
#include "systems/portrait/landmark_overlay.h"
#include "systems/portrait/landmark_portraits.h"
#include "systems/portrait/landmark_report.h"
#include "systems/portrait/landmark_run_folder.h"
#include "systems/portrait/landmark_split.h"
#include "systems/portrait/picture_files.h"
#include "systems/portrait/train/landmark_export.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace daumier::portrait {
namespace {

namespace fs = std::filesystem;

constexpr int kShapeSamples = 500, kSheetSide = 220, kSheetColumns = 6;
constexpr render::Rgb kTruthColour = {255, 255, 255};

class LandmarkEvaluation {
 public:
  LandmarkEvaluation(const fs::path& run_directory, const LandmarkEvalOptions& options, FolderCache& databases,
                     const Task& task)
      : options_(options),
        task_(task),
        run_(ReadLandmarkRunFolder(run_directory)),
        folder_(datasets::FindRunData(run_directory, run_.manifest, run_.config, "portraits", options.data.portraits)),
        source_(databases.Open<datasets::PortraitDatabase>(folder_)),
        split_(
            SplitSamples(source_, ParseOptions<datasets::SplitOptions>(run_.config.at("split")), run_.manifest.seed)),
        detector_(
            run_.network_options,
            std::make_shared<exporting::TorchRunner>(NetworkOf(DescribeLandmarkExport(run_directory)), torch::kCPU),
            options.detector) {
    DAUMIER_CHECK(SampleSplitToJson(source_, split_) == run_.manifest.details.at("split"),
                  "{}: the split does not match the run's manifest; the run is of another version",
                  run_directory.string());
    CheckFolders({options.pictures, options.rival, options.negatives});
    samples_ = EvenlySpaced(datasets::SubsetOf(split_, options.split), options.max_portraits);
    if (samples_.empty()) throw UsageError(fmt::format("the side '{}' of the split has no portrait", options.split));
  }

  reports::Evaluation Measure() {
    const Stopwatch stopwatch;
    MeasurePortraits();
    if (!options_.pictures.empty()) pictures_ = MeasurePictures(detector_, options_.pictures, options_.rival, task_);
    if (!options_.negatives.empty()) negatives_ = MeasureNegatives(detector_, options_.negatives, task_);
    seconds_ = stopwatch.seconds();
    const reports::MetricTable table = Table();
    const Json metrics = Metrics(table);
    return {.table = table,
            .metrics = metrics,
            .report = Report(table, metrics),
            .sheet = reports::Evaluation::Sheet{Sheet(), "White: truth; colours: the network. " +
                                                             std::string(pictures_.empty()
                                                                             ? "Portraits of median, worst 5 % and "
                                                                               "first by index."
                                                                             : "The given pictures.")},
            .manifest = ReportManifest()};
  }

 private:
  void MeasurePortraits() {
    const std::vector<float> shape = MeanShapeInBox(source_, EvenlySpaced(split_.train, kShapeSamples));
    Progress progress(task_.Stage("Portraits"), int64_t(samples_.size()), "portraits");
    for (const int sample : samples_) {
      task_.ThrowIfCancelled("the evaluation was stopped; nothing was written");
      portraits_.push_back(MeasurePortrait(detector_, source_.Get(sample), shape, labels_));
      progress.Step();
    }
  }

  reports::MetricTable Table() const {
    reports::MetricTable table{.columns = LandmarkColumns(), .faces = samples_};
    for (const int sample : samples_) table.groups.push_back(source_.person(sample));
    table.data_hash = {{"portraits", DataHash(folder_)}};
    const auto add = [&](const char* name, LandmarkErrors PortraitMeasurement::*of, bool is_searched) {
      reports::FaceValues values;
      for (const PortraitMeasurement& portrait : portraits_) {
        const LandmarkErrors& errors = portrait.*of;
        values["error"].push_back(errors.all);
        for (size_t part = 0; part < kLandmarkParts.size(); ++part)
          values[std::string(kLandmarkParts[part].name)].push_back(errors.parts[part]);
        if (is_searched) values["found"].push_back(portrait.found ? 1 : 0);
      }
      table.rows.push_back(reports::MakeRow(table, name, values, run_.manifest.seed));
    };
    add("network, face searched", &PortraitMeasurement::searched, true);
    add("network, box given", &PortraitMeasurement::boxed, false);
    add("network, box given, eyes not snapped", &PortraitMeasurement::unsnapped, false);
    add("mean shape, box given", &PortraitMeasurement::mean_shape, false);
    table.rows.back().baseline = true;
    return table;
  }

  Json Metrics(const reports::MetricTable& table) const {
    std::map<int, std::vector<double>> tones;
    for (const PortraitMeasurement& portrait : portraits_) tones[portrait.skin_tone].push_back(portrait.boxed.all);
    return {
        {"system", kLandmarkSystem},
        {"num_faces", samples_.size()},
        {"num_persons", std::set<int>(table.groups.begin(), table.groups.end()).size()},
        {"split", options_.split},
        {"normalised_error", table.rows[0].error().mean},
        {"table", reports::TableJson(table)},
        {"labels_iou", LabelsToJson(labels_)},
        {"states", StatesToJson(portraits_)},
        {"skin_tones", TonesToJson(tones)},
        {"pictures", pictures_.empty() ? Json() : PicturesToJson(pictures_)},
        {"negatives", negatives_.empty() ? Json() : NegativesToJson(negatives_, options_.detector.least_confidence)},
        {"data_hash", table.data_hash},
        {"faces", table.faces},
        {"groups", table.groups},
        {"seconds", seconds_}};
  }

  reports::ReportData Report(const reports::MetricTable& table, const Json& metrics) const {
    reports::ReportData report;
    report.title = fmt::format("Landmarks of portraits, {} split", options_.split);
    report.summary = fmt::format(
        "{} portraits of {} persons. Mean distance of 68 landmarks over the distance of the outer eye corners. A face "
        "that "
        "is not found counts as the mean shape in the whole picture. The interval resamples persons.",
        samples_.size(), metrics.at("num_persons").get<size_t>());
    report.tables = {reports::TextTable(table)};
    if (!pictures_.empty()) report.tables.push_back(PicturesTable(metrics.at("pictures")));
    reports::ReportTable classes{"Parsing, box given: intersection over union", {"class", "%"}, {}};
    for (const auto& [name, value] : metrics.at("labels_iou").items())
      classes.rows.push_back({name, fmt::format("{:.1f}", 100 * value.get<double>())});
    report.tables.push_back(classes);
    report.facts = {
        {"portraits (data hash)", table.data_hash.at("portraits").get<std::string>()},
        {"seed", fmt::format("{}", run_.manifest.seed)},
        {"spread over skin tones", fmt::format("{:.1f} %", 100 * metrics.at("skin_tones").at("spread").get<double>())},
        {"seconds", fmt::format("{:.1f}", seconds_)}};
    if (!negatives_.empty())
      report.facts.push_back(
          {"false faces", fmt::format("{} of {} pictures without a face",
                                      metrics.at("negatives").at("false_faces").get<int>(), negatives_.size())});
    return report;
  }

  render::Image Sheet() const {
    std::vector<render::SheetCell> cells;
    const auto add = [&](const render::Image& picture, std::span<const float> truth, std::span<const float> found,
                         const std::string& caption) {
      render::Image image = Fitted(picture, kSheetSide);
      const double scale = double(image.width) / picture.width;
      DrawLandmarks(image, truth, scale, 0.8, kTruthColour);
      if (!found.empty()) DrawLandmarks(image, found, scale, 1);
      cells.push_back({std::move(image), caption});
    };
    for (const PictureMeasurement& picture : pictures_)
      add(render::ReadImage(fs::path(options_.pictures) / picture.name), picture.truth,
          picture.face ? std::span<const float>(picture.face->landmarks) : std::span<const float>(),
          picture.errors ? fmt::format("{}: {:.1f} %", picture.name, 100 * picture.errors->all)
                         : fmt::format("{}: not found", picture.name));
    if (pictures_.empty()) {
      for (const size_t i : ShownPortraits()) {
        const LandmarkSample sample = source_.Get(samples_[i]);
        add(sample.picture, sample.landmarks, detector_.FindIn(sample.picture, BoxOf(sample.landmarks)).landmarks,
            fmt::format("{}: {:.1f} %", samples_[i], 100 * portraits_[i].boxed.all));
      }
    }
    return render::MakeSheet(cells, kSheetColumns);
  }

  /// Six portraits around the median, six around the worst 5 %, and the first six by index.
  std::vector<size_t> ShownPortraits() const {
    std::vector<size_t> order(portraits_.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::ranges::stable_sort(order, {}, [&](size_t i) { return portraits_[i].boxed.all; });
    std::vector<size_t> shown;
    for (const double share : {0.5, 0.95}) {
      const size_t last = order.size() - std::min(order.size(), size_t{6});
      const size_t begin = std::min(size_t(share * double(order.size())), last);
      for (size_t k = begin; k < std::min(order.size(), begin + 6); ++k) shown.push_back(order[k]);
    }
    for (size_t i = 0; i < std::min(order.size(), size_t{6}); ++i) shown.push_back(i);
    return shown;
  }

  Manifest ReportManifest() const {
    Manifest manifest{.kind = "report", .verb = "eval"};
    manifest.config = ToJson(options_);
    for (const char* folder : {"data", "pictures", "rival", "negatives"}) manifest.config.erase(folder);
    manifest.seed = run_.manifest.seed;
    manifest.sources = run_.manifest.sources;
    manifest.counts = {{"portraits", samples_.size()}};
    manifest.details = {{"system", kLandmarkSystem},
                        {"data", {{"portraits", DataHash(folder_)}}},
                        {"weights", Sha256OfFile(BestWeights(run_.directory))}};
    return manifest;
  }

  const LandmarkEvalOptions options_;
  const Task task_;
  const LandmarkRunFolder run_;
  const fs::path folder_;
  const PortraitSamples source_;
  const datasets::Split split_;
  const LandmarkDetector detector_;
  std::vector<int> samples_;
  std::vector<PortraitMeasurement> portraits_;
  std::vector<PictureMeasurement> pictures_;
  std::vector<NegativeMeasurement> negatives_;
  LabelCounts labels_;
  double seconds_ = 0;
};

}  // namespace

reports::Evaluation EvaluateLandmarks(const fs::path& run_directory, const LandmarkEvalOptions& options,
                                      FolderCache& databases, const Task& task) {
  return LandmarkEvaluation(run_directory, options, databases, task).Measure();
}

}  // namespace daumier::portrait
