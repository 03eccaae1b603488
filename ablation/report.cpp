#include "ablation/report.h"

#include "core/error.h"
#include "core/files.h"
#include "reports/curve_chart.h"
#include "reports/html_page.h"

#include <algorithm>
#include <map>

namespace daumier::ablation {
namespace {

namespace fs = std::filesystem;

using Place = AblationRuns::Place;

/// The rows of one split and seed that are done, as the table shows them.
std::vector<Place> DonePlaces(const Ablation& ablation, const AblationRuns& runs, const std::string& split,
                              uint64_t seed) {
  std::vector<Place> done;
  for (const AblationRow& row : ablation.rows)
    if (const Place place{row, split, seed}; runs.State(place) == RowState::kDone) done.push_back(place);
  return done;
}

void CheckSameTest(const std::vector<Place>& places, const AblationRuns& runs, const AblationTask& task) {
  const std::string first = task.TestedOn(runs.Metrics(places.front()));
  for (const Place& place : places) {
    const std::string here = task.TestedOn(runs.Metrics(place));
    DAUMIER_CHECK(here == first, "{} and {} were measured on different test faces: {} and {}",
                  places.front().Describe(), place.Describe(), first, here);
  }
}

std::vector<double> Minutes(const std::vector<double>& seconds) {
  std::vector<double> minutes;
  for (const double one : seconds) minutes.push_back(one / 60);
  return minutes;
}

/// curves.svg over steps and curves_by_time.svg over minutes: a panel a split with a curve a run, of validation and,
/// where the task tells it, of training.
bool WriteCurves(const std::vector<Place>& trained, const Ablation& ablation, const AblationRuns& runs,
                 const AblationTask& task, const fs::path& directory) {
  std::vector<reports::CurvePanel> by_steps, by_time;
  bool any = false;
  for (const std::string& split : ablation.options.splits) {
    for (const auto& [phase, metric] : {std::pair<std::string, std::string>{"validation", task.validation_metric()},
                                        {"train", task.training_metric()}}) {
      if (metric.empty()) continue;
      const std::string faces = phase == "train" ? ", training faces" : "";
      reports::CurvePanel steps{fmt::format("Split: {}{}", split, faces), {}}, time = steps;
      for (const Place& place : trained) {
        if (place.split != split) continue;
        const RunCurve curve = ReadCurve(runs.Run(place), phase, metric);
        any = any || !curve.steps.empty();
        steps.curves.push_back({place.row.name(), curve.steps, curve.errors});
        time.curves.push_back({place.row.name(), Minutes(curve.seconds), curve.errors});
      }
      if (steps.curves.empty()) continue;
      by_steps.push_back(std::move(steps));
      by_time.push_back(std::move(time));
    }
  }
  if (!any) return false;
  const std::string label = fmt::format("error ({})", task.unit());
  WriteFileAtomically(directory / "curves.svg",
                      reports::CurveChartSvg(by_steps, "Validation error while training", "steps", label));
  WriteFileAtomically(directory / "curves_by_time.svg",
                      reports::CurveChartSvg(by_time, "Validation error while training", "minutes of training", label));
  return true;
}

/// Tells each result of a training the least validation error within the time of the split's shortest one, as
/// validation_at_equal_time and equal_seconds. A run without steps has no curve and sets no time.
void CompareAtEqualTime(const std::vector<Place>& trained, const AblationRuns& runs, const AblationTask& task,
                        std::vector<AblationResult>& results) {
  std::map<std::string, double> shortest;
  for (const Place& place : trained) {
    const RunCurve curve = ReadCurve(runs.Run(place), "validation", task.validation_metric());
    if (curve.steps.empty() || curve.steps.back() == 0) continue;
    const auto [entry, is_new] = shortest.try_emplace(place.split, curve.seconds.back());
    entry->second = std::min(entry->second, curve.seconds.back());
  }
  for (AblationResult& result : results) {
    const auto place = std::find_if(trained.begin(), trained.end(), [&](const Place& one) {
      return one.row.name() == result.name && one.split == result.split && one.seed == result.seed;
    });
    if (result.baseline || place == trained.end() || shortest.count(result.split) == 0) continue;
    const double seconds = shortest.at(result.split);
    const auto least = LeastWithin(ReadCurve(runs.Run(*place), "validation", task.validation_metric()), seconds);
    result.measure.more["equal_seconds"] = seconds;
    result.measure.more["validation_at_equal_time"] = least ? Json(*least) : Json();
  }
}

void WriteSheet(const std::vector<Place>& places, const AblationRuns& runs, const AblationTask& task,
                const fs::path& file) {
  std::vector<AblationPicture> pictures;
  for (const Place& place : places)
    if (runs.Result(place).measure.of_run) pictures.push_back(runs.Picture(place));
  if (!pictures.empty()) task.WriteSheet(pictures, file);
}

std::string Page(const Json& table, bool has_curves, bool has_sheet) {
  reports::HtmlPage page{.title = "Ablation", .summary = AblationFootnote(), .tables = AblationTables(table)};
  if (has_sheet)
    page.figures.push_back(
        {"Side by side", "sheet.png",
         "The face of median error of the first row, the one where its worst 5 % begin, and the first "
         "test face. Each row of the table: its face, coloured by the distance from the true one."});
  if (has_curves)
    page.figures.push_back(
        {"Training", "curves.svg", "Errors over steps; a circle marks the least, and the legend tells it."});
  if (has_curves) page.figures.push_back({"Training by time", "curves_by_time.svg", "The same over minutes."});
  return reports::PageHtml(page);
}

}  // namespace

Json WriteAblationReport(const Ablation& ablation, const AblationTask& task, const AblationRuns& runs,
                         const fs::path& directory, bool with_sheet) {
  std::vector<AblationResult> results;
  std::vector<Place> trained;
  for (const std::string& split : ablation.options.splits) {
    for (const uint64_t seed : ablation.options.seeds) {
      const std::vector<Place> places = DonePlaces(ablation, runs, split, seed);
      if (places.empty()) continue;
      if (ablation.options.evaluate) CheckSameTest(places, runs, task);
      for (const Place& place : places)
        if (place.row.trains()) trained.push_back(place);
      for (const Place& place : places) {
        const std::vector<AblationResult> baselines = runs.Baselines(place);
        results.insert(results.end(), baselines.begin(), baselines.end());
        if (!baselines.empty()) break;  // They are the same for all rows.
      }
      for (const Place& place : places) results.push_back(runs.Result(place));
    }
  }
  CompareAtEqualTime(trained, runs, task, results);
  const Json table = AblationTableJson(results, task.unit(), ablation.options.compare_to);
  WriteFileAtomically(directory / "table.md", AblationMarkdown(table));
  WriteFileAtomically(directory / "table.json", table.dump(2) + "\n");
  const bool has_curves = WriteCurves(trained, ablation, runs, task, directory);
  const fs::path sheet = directory / "sheet.png";
  if (with_sheet && ablation.options.evaluate)
    WriteSheet(DonePlaces(ablation, runs, ablation.options.splits.front(), ablation.options.seeds.front()), runs, task,
               sheet);
  WriteFileAtomically(directory / "index.html", Page(table, has_curves, fs::exists(sheet)));
  return table;
}

}  // namespace daumier::ablation
