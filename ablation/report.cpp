#include "ablation/report.h"

#include "core/error.h"
#include "core/files.h"
#include "reports/ablation_tables.h"
#include "reports/comparison_sheet.h"
#include "reports/curve_chart.h"
#include "reports/html_page.h"

#include <algorithm>
#include <map>
#include <optional>

namespace daumier::ablation {
namespace {

namespace fs = std::filesystem;

/// The rows of one split and seed that are done, as the table shows them.
std::vector<AblationRuns::Cell> DoneCells(const Ablation& ablation, const AblationRuns& runs, const std::string& split,
                                          uint64_t seed) {
  std::vector<AblationRuns::Cell> done;
  for (const AblationRow& row : ablation.rows)
    if (const AblationRuns::Cell cell{row, split, seed}; runs.State(cell) == RowState::kDone) done.push_back(cell);
  return done;
}

void CheckSameTest(const std::vector<AblationRuns::Cell>& cells, const AblationRuns& runs) {
  const std::string first = TestSetId(runs.Metrics(cells.front()));
  for (const AblationRuns::Cell& cell : cells) {
    const std::string here = TestSetId(runs.Metrics(cell));
    DAUMIER_CHECK(here == first, "{} and {} were measured on different test faces: {} and {}", cells.front().Describe(),
                  cell.Describe(), first, here);
  }
}

std::vector<double> Minutes(const std::vector<double>& seconds) {
  std::vector<double> minutes;
  for (const double one : seconds) minutes.push_back(one / 60);
  return minutes;
}

/// curves.svg over steps and curves_by_time.svg over minutes: a panel a split with a curve a run, of validation and,
/// if the system logs it, of training.
bool WriteCurves(const std::vector<AblationRuns::Cell>& trained, const Ablation& ablation, const AblationRuns& runs,
                 const systems::SystemTraining& training, const fs::path& directory) {
  std::vector<reports::CurvePanel> by_steps, by_time;
  bool any = false;
  for (const std::string& split : ablation.options.splits) {
    for (const std::string phase : {"validation", "train"}) {
      const std::string metric(phase == "train" ? training.training_metric : training.validation_metric);
      if (metric.empty()) continue;
      const std::string faces = phase == "train" ? ", training faces" : "";
      reports::CurvePanel steps{fmt::format("Split: {}{}", split, faces), {}}, time = steps;
      for (const AblationRuns::Cell& cell : trained) {
        if (cell.split != split) continue;
        const RunCurve curve = ReadCurve(runs.Run(cell), phase, metric);
        any = any || !curve.steps.empty();
        steps.curves.push_back({cell.row.name(), curve.steps, curve.errors});
        time.curves.push_back({cell.row.name(), Minutes(curve.seconds), curve.errors});
      }
      if (steps.curves.empty()) continue;
      by_steps.push_back(std::move(steps));
      by_time.push_back(std::move(time));
    }
  }
  if (!any) return false;
  const std::string label = "error (mm)";
  WriteFileAtomically(directory / "curves.svg",
                      reports::CurveChartSvg(by_steps, "Validation error while training", "steps", label));
  WriteFileAtomically(directory / "curves_by_time.svg",
                      reports::CurveChartSvg(by_time, "Validation error while training", "minutes of training", label));
  return true;
}

/// Adds validation_at_equal_time and equal_seconds to each result of a training: the least validation error within the
/// time of the split's shortest one. A run without steps has no curve and sets no time.
void CompareAtEqualTime(const std::vector<AblationRuns::Cell>& trained, const AblationRuns& runs,
                        const std::string& metric, std::vector<AblationResult>& results) {
  std::map<std::string, double> shortest;
  for (const AblationRuns::Cell& cell : trained) {
    const RunCurve curve = ReadCurve(runs.Run(cell), "validation", metric);
    if (curve.steps.empty() || curve.steps.back() == 0) continue;
    const auto [entry, is_new] = shortest.try_emplace(cell.split, curve.seconds.back());
    entry->second = std::min(entry->second, curve.seconds.back());
  }
  for (AblationResult& result : results) {
    const auto cell = std::find_if(trained.begin(), trained.end(), [&](const AblationRuns::Cell& one) {
      return one.row.name() == result.name && one.split == result.split && one.seed == result.seed;
    });
    if (result.baseline || cell == trained.end() || shortest.count(result.split) == 0) continue;
    const double seconds = shortest.at(result.split);
    const auto least = LeastWithin(ReadCurve(runs.Run(*cell), "validation", metric), seconds);
    result.measure.more["equal_seconds"] = seconds;
    result.measure.more["validation_at_equal_time"] = least ? Json(*least) : Json();
  }
}

/// Faces of which every report keeps a prediction, chosen by the errors of the first row.
std::vector<reports::ChosenFace> FacesOfSheet(const std::vector<reports::Predictions>& rows,
                                              const reports::MetricTable& first) {
  std::vector<int> faces;
  std::vector<double> errors;
  const std::vector<double>& all = reports::FindRow(first, "").face_errors;
  for (size_t i = 0; i < first.faces.size(); ++i) {
    const bool everywhere = std::all_of(rows.begin(), rows.end(), [&](const reports::Predictions& row) {
      return std::any_of(row.faces.begin(), row.faces.end(),
                         [&](const reports::FacePrediction& one) { return one.face == first.faces[i]; });
    });
    if (!everywhere) continue;
    faces.push_back(first.faces[i]);
    errors.push_back(all.at(i));
  }
  return reports::ChooseFaces(faces, errors);
}

void WriteSheet(const std::vector<AblationRuns::Cell>& cells, const AblationRuns& runs, const fs::path& file) {
  std::vector<std::string> names;
  std::vector<reports::Predictions> rows;
  std::optional<reports::MetricTable> first;
  for (const AblationRuns::Cell& cell : cells) {
    if (!runs.Result(cell).measure.is_result) continue;
    std::optional<reports::Predictions> predictions = runs.Predictions(cell);
    if (!predictions) continue;
    if (!first) first = runs.Table(cell);
    names.push_back(cell.row.name());
    rows.push_back(std::move(*predictions));
  }
  if (rows.empty()) return;
  std::vector<reports::ComparedFace> faces;
  for (const reports::ChosenFace& chosen : FacesOfSheet(rows, *first)) {
    const reports::FacePrediction& input = rows.front().at(chosen.face);
    reports::ComparedFace& face =
        faces.emplace_back(reports::ComparedFace{chosen.title, input.sketch, input.truth, {}});
    for (const reports::Predictions& row : rows) {
      const reports::FacePrediction& one = row.at(chosen.face);
      face.predictions.push_back({one.prediction, one.error_mm, one.mean_error_mm()});
    }
  }
  render::WriteImage(file, reports::ComparisonSheet(rows.front().surface, names, faces));
}

std::string Page(const Json& table, const std::vector<reports::Metric>& columns, bool has_curves, bool has_sheet) {
  reports::HtmlPage page{
      .title = "Ablation", .summary = reports::AblationFootnote(), .tables = reports::AblationTables(table, columns)};
  if (has_sheet)
    page.figures.push_back(
        {"Side by side", "sheet.png",
         "Of the test faces that all reports keep (at least 16, evenly spread): the one of median error of the first "
         "row, the one where its worst 5 % begin, its worst, and the first. Each row of the table: its face, coloured "
         "by the distance from the true one."});
  if (has_curves)
    page.figures.push_back(
        {"Training", "curves.svg", "Errors over steps; a circle marks the least, also in the legend."});
  if (has_curves) page.figures.push_back({"Training by time", "curves_by_time.svg", "The same over minutes."});
  return reports::PageHtml(page);
}

}  // namespace

Json WriteAblationReport(const Ablation& ablation, const AblationRuns& runs, const AblationSystem& system,
                         const fs::path& directory, RowSheet row_sheet) {
  std::vector<AblationResult> results;
  std::vector<AblationRuns::Cell> trained;
  for (const std::string& split : ablation.options.splits) {
    for (const uint64_t seed : ablation.options.seeds) {
      const std::vector<AblationRuns::Cell> cells = DoneCells(ablation, runs, split, seed);
      if (cells.empty()) continue;
      if (ablation.options.evaluate) CheckSameTest(cells, runs);
      for (const AblationRuns::Cell& cell : cells)
        if (cell.row.trains()) trained.push_back(cell);
      for (const AblationRuns::Cell& cell : cells) {
        const std::vector<AblationResult> baselines = runs.Baselines(cell);
        results.insert(results.end(), baselines.begin(), baselines.end());
        if (!baselines.empty()) break;  // They are the same for all rows.
      }
      for (const AblationRuns::Cell& cell : cells) results.push_back(runs.Result(cell));
    }
  }
  CompareAtEqualTime(trained, runs, std::string(system.training.validation_metric), results);
  const Json table = AblationTableJson(results, ablation.options.compare_to);
  const std::vector<reports::Metric> columns = system.system.summary_columns();
  WriteFileAtomically(directory / "table.md", reports::AblationMarkdown(table, columns));
  WriteFileAtomically(directory / "table.json", table.dump(2) + "\n");
  const bool has_curves = WriteCurves(trained, ablation, runs, system.training, directory);
  const fs::path sheet = directory / "sheet.png";
  if (row_sheet == RowSheet::kDraw && ablation.options.evaluate)
    WriteSheet(DoneCells(ablation, runs, ablation.options.splits.front(), ablation.options.seeds.front()), runs, sheet);
  WriteFileAtomically(directory / "index.html", Page(table, columns, has_curves, fs::exists(sheet)));
  return table;
}

}  // namespace daumier::ablation
