#include "train/ablation_report.h"

#include "core/error.h"
#include "core/files.h"
#include "eval/curve_chart.h"
#include "eval/html_page.h"

namespace daumier::train {
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

/// curves.svg: a panel a split, a curve a run.
bool WriteCurves(const std::vector<Place>& trained, const Ablation& ablation, const AblationRuns& runs,
                 const AblationTask& task, const fs::path& file) {
  std::vector<eval::CurvePanel> panels;
  bool any = false;
  for (const std::string& split : ablation.options.splits) {
    eval::CurvePanel panel{fmt::format("Split: {}", split), {}};
    for (const Place& place : trained) {
      if (place.split != split) continue;
      ValidationCurve curve = ReadValidationCurve(runs.Run(place), task.validation_metric());
      any = any || !curve.steps.empty();
      panel.curves.push_back({place.row.name(), std::move(curve.steps), std::move(curve.errors)});
    }
    if (!panel.curves.empty()) panels.push_back(std::move(panel));
  }
  if (any)
    WriteFileAtomically(file, eval::CurveChartSvg(panels, "Validation error while training", "steps",
                                                  fmt::format("validation error ({})", task.unit())));
  return any;
}

void WriteSheet(const std::vector<Place>& places, const AblationRuns& runs, const AblationTask& task,
                const fs::path& file) {
  std::vector<AblationPicture> pictures;
  for (const Place& place : places)
    if (runs.Result(place).measure.of_run) pictures.push_back(runs.Picture(place));
  if (!pictures.empty()) task.WriteSheet(pictures, file);
}

std::string Page(const Json& table, bool has_curves, bool has_sheet) {
  eval::HtmlPage page{.title = "Ablation", .summary = AblationFootnote(), .tables = AblationTables(table)};
  if (has_sheet)
    page.figures.push_back(
        {"Side by side", "sheet.png",
         "The face of median error of the first row, the one where its worst 5 % begin, and the first "
         "test face. Each row of the table: its face, coloured by the distance from the true one."});
  if (has_curves)
    page.figures.push_back(
        {"Training", "curves.svg",
         "Validation error after each epoch; a circle marks the weights that are kept, and the legend "
         "tells their error."});
  return eval::PageHtml(page);
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
      CheckSameTest(places, runs, task);
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
  const Json table = AblationTableJson(results, task.unit());
  WriteFileAtomically(directory / "table.md", AblationMarkdown(table));
  WriteFileAtomically(directory / "table.json", table.dump(2) + "\n");
  const bool has_curves = WriteCurves(trained, ablation, runs, task, directory / "curves.svg");
  const fs::path sheet = directory / "sheet.png";
  if (with_sheet)
    WriteSheet(DonePlaces(ablation, runs, ablation.options.splits.front(), ablation.options.seeds.front()), runs, task,
               sheet);
  WriteFileAtomically(directory / "index.html", Page(table, has_curves, fs::exists(sheet)));
  return table;
}

}  // namespace daumier::train
