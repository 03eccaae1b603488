#include "reports/evaluation.h"

#include "core/error.h"
#include "core/files.h"
#include "core/output_place.h"
#include "core/staged_directory.h"

namespace daumier::reports {
namespace {

namespace fs = std::filesystem;

constexpr const char* kKind = "report";
constexpr const char* kMetricsFile = "metrics.json";
constexpr const char* kPredictionsFile = "predictions.safetensors";

void WriteSheetReport(const fs::path& folder, const Evaluation& evaluation) {
  const ReportData& report = evaluation.report;
  render::WriteImage(folder / "sheet.png", evaluation.sheet->image);
  std::vector<HtmlFigure> figures = {{"Samples", "sheet.png", evaluation.sheet->caption}};
  for (const Evaluation::Picture& picture : evaluation.pictures) {
    render::WriteImage(folder / picture.file, picture.sheet.image);
    figures.push_back({picture.title, picture.file, picture.sheet.caption});
  }
  WriteFileAtomically(folder / "index.html", PageHtml({.title = report.title,
                                                       .summary = report.summary,
                                                       .tables = report.tables,
                                                       .figures = figures,
                                                       .facts = report.facts}));
}

}  // namespace

void CheckReportDirectory(const fs::path& out, const std::vector<fs::path>& inputs) {
  CheckReplacedFolder(out, kKind, inputs);
}

void WriteEvaluation(const fs::path& out, const Evaluation& evaluation) {
  DAUMIER_CHECK(evaluation.manifest.kind == kKind, "the manifest of an evaluation is of kind '{}', expected '{}'",
                evaluation.manifest.kind, kKind);
  StagedDirectory staged(out, kKind);
  const fs::path& folder = staged.path();
  if (evaluation.sheet) {
    WriteSheetReport(folder, evaluation);
  } else {
    WriteReport(folder, evaluation.report);
  }
  WriteFileAtomically(folder / "table.md", TableMarkdown(TextTable(evaluation.table)));
  WriteFileAtomically(folder / kMetricsFile, evaluation.metrics.dump(2) + "\n");
  if (evaluation.predictions) WritePredictions(folder / kPredictionsFile, *evaluation.predictions);
  Manifest manifest = evaluation.manifest;
  for (const auto& file : fs::directory_iterator(folder))
    manifest.checksums[file.path().filename().string()] = Sha256OfFile(file.path());
  WriteManifest(folder, manifest);
  staged.Commit();
}

Json ReadMetrics(const fs::path& report) {
  return ReadJson(report / kMetricsFile);
}

std::optional<Predictions> ReadReportPredictions(const fs::path& report) {
  const fs::path file = report / kPredictionsFile;
  return fs::exists(file) ? std::optional(ReadPredictions(file)) : std::nullopt;
}

}  // namespace daumier::reports
