#pragma once
#include "core/json.h"
#include "eval/metrics.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace daumier::ablation {

/// A line of a report's table, as an ablation needs it.
struct AblationMeasure {
  double error = 0;
  std::optional<eval::Interval> interval = {};
  bool of_run = false;  ///< The line is the run's own network, so that what the run cost belongs to it.
  /// Further columns by their names in table.json: p90, shape_input, data_hash, ...
  Json more = Json::object();
  /// The error of every test face, and what is resampled as one; empty where the report does not tell them.
  std::vector<double> face_errors = {};
  std::vector<int> groups = {};
};

/// A row whose network is shown in a sheet.
struct AblationPicture {
  std::string name;
  std::string shape_input;  ///< As the row tells it.
  std::filesystem::path run;
  Json eval;     ///< Options of its evaluation; a reference to a row holds that row's run folder.
  Json metrics;  ///< Of its report.
};

/// One kind of run, seen by an ablation: how it is configured, trained, measured and shown. Everything else of an
/// ablation is the same for all kinds.
class AblationTask {
 public:
  virtual ~AblationTask() = default;

  /// The whole config of a run, every option present. `where` names the row in messages. @throws UsageError as
  /// ParseOptions.
  virtual Json ResolvedConfig(Json config, uint64_t seed, const std::string& split, const std::string& where) const = 0;
  /// Options of an evaluation, every one present. @throws UsageError as ParseOptions.
  virtual Json ResolvedEval(const Json& eval, const std::string& where) const = 0;
  /// Options of an evaluation that are run folders, and name rows in an ablation's config.
  virtual std::vector<std::string> references() const = 0;

  /// Whether a training with that resolved config has come to its end there.
  /// @throws UsageError if the run there has another config or other data, saying what differs.
  virtual bool Finished(const std::filesystem::path& run, const Json& config) const = 0;
  /// Trains, or goes on with what is there.
  virtual void Train(const Json& config, const std::filesystem::path& run) const = 0;
  /// Writes a report with metrics.json.
  virtual void Evaluate(const std::filesystem::path& run, const Json& eval,
                        const std::filesystem::path& report) const = 0;
  /// Milliseconds from one input to its vertices: the median of some runs with batch 1 on the CPU, with LibTorch's
  /// threads as they are.
  virtual double InferMs(const std::filesystem::path& run) const = 0;

  /// The unit of all errors.
  virtual std::string unit() const = 0;
  /// The name of the validation error in metrics.jsonl.
  virtual std::string validation_metric() const = 0;
  /// The name of an error of training samples, by which an ablation draws a curve of training beside that of
  /// validation; empty: none.
  virtual std::string training_metric() const { return ""; }
  /// The lines of a report that need no training, as a table shows them on top.
  virtual std::vector<std::string> baselines() const = 0;
  /// Whether a report has that line; it may have been made without free baselines.
  virtual bool HasLine(const Json& metrics, const std::string& line) const = 0;
  /// A line of a report's table, by default the result of the run. @throws Error if the report has no such line.
  virtual AblationMeasure Measure(const Json& metrics, const std::string& line,
                                  const std::string& shape_input) const = 0;
  /// Whether reports were measured on the same test faces: equal texts.
  virtual std::string TestedOn(const Json& metrics) const = 0;
  /// Writes a picture of the rows side by side on some test faces that the first one chooses.
  virtual void WriteSheet(const std::vector<AblationPicture>& rows, const std::filesystem::path& file) const = 0;
};

}  // namespace daumier::ablation
