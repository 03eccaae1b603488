#include "systems/sketch/train/gesture_evaluation.h"

#include "core/error.h"
#include "core/evenly_spaced.h"
#include "core/files.h"
#include "core/progress.h"
#include "core/run_manifest.h"
#include "core/statistics.h"
#include "core/stopwatch.h"
#include "datasets/gallery/gesture_sheet.h"
#include "datasets/gestures/stroke_form.h"
#include "datasets/gestures/test_gestures.h"
#include "datasets/read/gesture_database.h"
#include "datasets/read/run_data.h"
#include "render/read_drawing.h"
#include "render/sheet.h"
#include "systems/sketch/gesture_counts.h"
#include "systems/sketch/gesture_metrics.h"
#include "systems/sketch/gesture_options.h"
#include "systems/sketch/gesture_predictor.h"

#include <algorithm>
#include <array>

namespace daumier::sketch {
namespace {

namespace fs = std::filesystem;
using datasets::Gesture;

constexpr int kShownErrors = 48, kErrorColumns = 8;

int NumMeasured(Gesture gesture, const GestureEvalOptions& options) {
  return gesture == Gesture::kNone ? options.none : options.per_gesture;
}

std::vector<datasets::LabelledStroke> StrokesOfRun(const datasets::GestureDatabase& database,
                                                   const std::vector<int>& subset, const GestureEvalOptions& options) {
  std::array<std::vector<int>, kNumGestureClasses> of_classes;
  for (const int index : subset) of_classes[size_t(database.stroke(index).gesture)].push_back(index);
  std::vector<datasets::LabelledStroke> strokes;
  for (size_t gesture = 0; gesture < of_classes.size(); ++gesture)
    for (const int index : EvenlySpaced(of_classes[gesture], NumMeasured(Gesture(gesture), options)))
      strokes.push_back(database.stroke(index));
  return strokes;
}

/// Each by another hand.
std::vector<datasets::LabelledStroke> IndependentStrokes(const GestureEvalOptions& options) {
  std::vector<datasets::LabelledStroke> strokes;
  for (int gesture = 0; gesture < kNumGestureClasses; ++gesture) {
    for (int i = 0; i < NumMeasured(Gesture(gesture), options); ++i) {
      Rng rng = Stream(options.seed, "independent " + NameOf(Gesture(gesture)), uint64_t(i));
      strokes.push_back({.points = datasets::DrawTestGesture(Gesture(gesture), rng),
                         .gesture = Gesture(gesture),
                         .hand = int(strokes.size())});
    }
  }
  return strokes;
}

const std::vector<int>& SubsetNamed(const datasets::GestureSplit& split, const std::string& name) {
  if (name == "train") return split.train;
  return name == "validation" ? split.validation : split.test;
}

std::string KindOf(const datasets::LabelledStroke& stroke) {
  return stroke.other ? NameOf(*stroke.other) : "";
}

std::string Percent(double share) {
  return fmt::format("{:.1f} %", 100 * share);
}

class GestureEvaluation {
 public:
  GestureEvaluation(const fs::path& directory, const GestureEvalOptions& options, FolderCache& databases,
                    const Task& task)
      : options_(options),
        task_(task),
        run_(ReadGestureRunFolder(directory)),
        recogniser_(OpenGestureRecogniser(directory)) {
    if (options.strokes == "independent") {
      strokes_ = IndependentStrokes(options);
      return;
    }
    const fs::path folder =
        datasets::FindRunData(directory, run_.manifest, run_.config, "gestures", options.data.gestures);
    const auto& database = databases.Open<datasets::GestureDatabase>(folder);
    const auto shares = ParseOptions<GestureSplitOptions>(run_.config.at("split"), "split of the run");
    const datasets::GestureSplit split =
        datasets::SplitByHand(database, shares.validation, shares.test, run_.manifest.seed);
    strokes_ = StrokesOfRun(database, SubsetNamed(split, options.split), options);
    data_hash_ = {{"gestures", DataHash(folder)}};
  }

  reports::Evaluation Measure() {
    const Stopwatch stopwatch;
    MeasureStrokes();
    if (errors_.empty())
      throw UsageError(fmt::format("the side '{}' of the split has no stroke of the ten gestures", options_.split));
    if (!options_.drawings.empty()) MeasureDrawings();
    const reports::MetricTable table = Table();
    Json metrics = Metrics(table);
    metrics["seconds"] = stopwatch.seconds();
    return {.table = table, .metrics = metrics, .report = Report(table, metrics), .sheet = Sheet(), .manifest = Own()};
  }

 private:
  void MeasureStrokes() {
    Progress progress(task_.Stage("Strokes"), int64_t(strokes_.size()), "strokes");
    for (size_t i = 0; i < strokes_.size(); ++i) {
      task_.ThrowIfCancelled("the evaluation was stopped; nothing was written");
      const datasets::LabelledStroke& stroke = strokes_[i];
      const Stopwatch stopwatch;
      const RecognisedGesture found = recogniser_.Recognise(stroke.points);
      milliseconds_.push_back(1e3 * stopwatch.seconds());
      counts_.Add(stroke.gesture, found, KindOf(stroke));
      (stroke.gesture == Gesture::kNone ? none_probabilities_ : probabilities_).push_back(found.probability);
      if (stroke.gesture != Gesture::kNone) {
        gestures_.push_back(int(i));
        hands_.push_back(stroke.hand);
        errors_.push_back(found.likeliest == stroke.gesture ? 0 : 1);
        missed_.push_back(found.gesture == Gesture::kNone ? 1 : 0);
      }
      if (found.gesture != stroke.gesture) mistakes_.push_back({stroke, found});
      progress.Step();
    }
  }

  void MeasureDrawings() {
    int num_straight = 0, num_closed = 0, num_points = 0;
    GestureCounts counts;
    for (const render::Drawing& drawing : render::ReadDrawings(options_.drawings)) {
      for (const render::Stroke& stroke : drawing.strokes) {
        const datasets::Polyline line = PolylineOf(stroke);
        if (line.empty() || datasets::BoxOf(line).sizes().maxCoeff() == 0) {
          ++num_points;
          continue;
        }
        const datasets::StrokeForm form = datasets::FormOf(line);
        if (form.is_nearly_straight())
          ++num_straight;
        else if (form.is_nearly_closed())
          ++num_closed;
        else
          counts.Add(Gesture::kNone, recogniser_.Recognise(line));
      }
    }
    drawings_ = counts.ToJson();
    drawings_.update({{"nearly_straight", num_straight}, {"nearly_closed", num_closed}, {"points", num_points}});
  }

  /// Of other strokes, at the threshold that accepts as many of these gestures as the run's does of validation ones.
  Json RejectedAtAccepted() const {
    const auto options = ParseOptions<GestureRejectionOptions>(run_.config.at("rejection"), "rejection of the run");
    const GestureRejection rejection = ChooseRejection(probabilities_, options.accepted);
    Json json = RejectionToJson(rejection);
    if (none_probabilities_.empty()) return json;
    const auto num_rejected =
        std::ranges::count_if(none_probabilities_, [&](double p) { return p < rejection.threshold; });
    json["rejected"] = double(num_rejected) / double(none_probabilities_.size());
    return json;
  }

  reports::MetricTable Table() const {
    reports::MetricTable table{
        .columns = GestureColumns(), .faces = gestures_, .groups = hands_, .data_hash = data_hash_};
    table.rows.push_back(
        reports::MakeRow(table, "recogniser", {{"error", errors_}, {"missed", missed_}}, run_.manifest.seed));
    if (counts_.num_none() > 0)
      table.rows.back().values[*reports::FindColumn(table.columns, "none_accepted")] =
          reports::MetricValue{1 - counts_.rejected()};
    return table;
  }

  Json Metrics(const reports::MetricTable& table) const {
    Json metrics = counts_.ToJson();
    metrics.update({{"system", kGestureSystem},
                    {"strokes", options_.strokes},
                    {"split", options_.strokes == "run" ? options_.split : "independent"},
                    {"num_faces", gestures_.size()},
                    {"table", reports::TableJson(table)},
                    {"rejection", run_.manifest.details.at("rejection")},
                    {"at_accepted", RejectedAtAccepted()},
                    {"milliseconds", Median(milliseconds_)},
                    {"data_hash", table.data_hash},
                    {"faces", table.faces},
                    {"groups", table.groups}});
    if (!drawings_.is_null()) metrics["drawings"] = drawings_;
    return metrics;
  }

  reports::ReportData Report(const reports::MetricTable& table, const Json& metrics) const {
    reports::ReportData report;
    report.title = options_.strokes == "run" ? fmt::format("Pen gestures, {} split", options_.split)
                                             : std::string("Pen gestures, independent strokes");
    report.summary = fmt::format(
        "{} strokes of the ten gestures and {} others, {} of the gestures are "
        "right, "
        "{} are accepted, {} of the others are rejected. The interval resamples hands.",
        counts_.num_gestures(), counts_.num_none(), Percent(counts_.accuracy()), Percent(counts_.accepted()),
        Percent(counts_.rejected()));
    report.tables = {reports::TextTable(table), Confusion(metrics.at("confusion"))};
    reports::ReportTable kinds{"Strokes that are no gesture", {"kind", "number", "accepted"}, {}};
    for (const auto& [kind, of_kind] : metrics.at("none_by_kind").items())
      kinds.rows.push_back({kind, of_kind.at("num").dump(), of_kind.at("accepted").dump()});
    report.tables.push_back(kinds);
    report.facts = {{"gestures (data hash)", data_hash_.value("gestures", "")},
                    {"seed", fmt::format("{}", run_.manifest.seed)},
                    {"threshold", metrics.at("rejection").at("threshold").dump()},
                    {"milliseconds a stroke", fmt::format("{:.2f}", Median(milliseconds_))}};
    return report;
  }

  static reports::ReportTable Confusion(const Json& confusion) {
    reports::ReportTable table{"Recognised as", {"stroke"}, {}};
    for (int found = 0; found < kNumGestureClasses; ++found) table.header.push_back(NameOf(Gesture(found)));
    for (int truth = 0; truth < kNumGestureClasses; ++truth) {
      const Json row = confusion.value(NameOf(Gesture(truth)), Json::object());
      table.rows.push_back({NameOf(Gesture(truth))});
      for (int found = 0; found < kNumGestureClasses; ++found)
        table.rows.back().push_back(fmt::format("{}", row.value(NameOf(Gesture(found)), 0)));
    }
    return table;
  }

  reports::Evaluation::Sheet Sheet() const {
    std::vector<render::SheetCell> cells;
    for (const Mistake& mistake : EvenlySpaced(mistakes_, kShownErrors)) {
      const datasets::LabelledStroke& stroke = mistake.stroke;
      cells.push_back({datasets::PictureOfStroke(stroke.points),
                       fmt::format("{}: {}", stroke.other ? KindOf(stroke) : NameOf(stroke.gesture),
                                   NameOf(mistake.found.gesture))});
    }
    if (cells.empty())
      for (const int index : EvenlySpaced(gestures_, kErrorColumns))
        cells.push_back({datasets::PictureOfStroke(strokes_[size_t(index)].points), "right"});
    return {render::MakeSheet(cells, kErrorColumns),
            "Strokes that are recognised as something else, evenly spaced: what they are, and as what."};
  }

  Manifest Own() const {
    Manifest manifest{.kind = "report", .verb = "eval"};
    manifest.config = ToJson(options_);
    manifest.config.erase("data");
    manifest.config.erase("drawings");
    manifest.seed = run_.manifest.seed;
    manifest.sources = run_.manifest.sources;
    manifest.counts = {{"gestures", counts_.num_gestures()}, {"none", counts_.num_none()}};
    manifest.details = {
        {"system", kGestureSystem}, {"data", data_hash_}, {"weights", Sha256OfFile(BestWeights(run_.directory))}};
    return manifest;
  }

  struct Mistake {
    datasets::LabelledStroke stroke;
    RecognisedGesture found;
  };

  const GestureEvalOptions options_;
  const Task task_;
  const GestureRunFolder run_;
  const GestureRecogniser recogniser_;
  std::vector<datasets::LabelledStroke> strokes_;
  Json data_hash_ = Json::object();
  GestureCounts counts_;
  std::vector<int> gestures_, hands_;  ///< Of strokes_, those of the ten gestures.
  std::vector<double> errors_, missed_, milliseconds_;
  std::vector<double> probabilities_, none_probabilities_;  ///< Of the likeliest gesture.
  std::vector<Mistake> mistakes_;
  Json drawings_;
};

}  // namespace

reports::Evaluation EvaluateGestures(const fs::path& run_directory, const GestureEvalOptions& options,
                                     FolderCache& databases, const Task& task) {
  return GestureEvaluation(run_directory, options, databases, task).Measure();
}

}  // namespace daumier::sketch
