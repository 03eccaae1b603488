#pragma once
#include "core/manifest.h"
#include "reports/metric_table.h"
#include "reports/predictions.h"
#include "reports/report.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace daumier::reports {

/// What `daumier eval` measures of a run, in memory.
struct Evaluation {
  MetricTable table;
  Json metrics;  ///< metrics.json
  ReportData report;
  /// In place of the pictures of the report, of faces that have no error of each vertex: sheet.png and its caption.
  struct Sheet {
    render::Image image;
    std::string caption;
  };
  std::optional<Sheet> sheet = {};
  Manifest manifest;                            ///< Of kind "report", without checksums.
  std::optional<Predictions> predictions = {};  ///< Of the result, of the faces of KeptFaces.
  /// Further pictures of an evaluation with a sheet, JPEG.
  struct Picture {
    std::string title, file;  ///< "pictures.jpg"
    Sheet sheet;
  };
  std::vector<Picture> pictures = {};
};

/// @throws UsageError as CheckReplacedFolder, as WriteEvaluation would.
void CheckReportDirectory(const std::filesystem::path& out, const std::vector<std::filesystem::path>& inputs = {});

/// Writes metrics.json, table.md, index.html, the pictures (sheet.png; with a sheet of its own `pictures`, otherwise
/// mean_error.png and errors.svg), predictions.safetensors where there are any, and manifest.json with their checksums.
/// The folder is written whole or not at all; it replaces an earlier report. @throws Error as CheckReportDirectory and
/// WriteReport.
void WriteEvaluation(const std::filesystem::path& out, const Evaluation& evaluation);

/// metrics.json of a report. @throws Error naming file and cause.
Json ReadMetrics(const std::filesystem::path& report);
/// Predictions of a report, absent if it has none.
std::optional<Predictions> ReadReportPredictions(const std::filesystem::path& report);

}  // namespace daumier::reports
