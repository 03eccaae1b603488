#pragma once
#include "ablation/config.h"
#include "ablation/table.h"
#include "reports/predictions.h"
#include "systems/system.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace daumier::ablation {

/// What an ablation trains and measures, and where.
struct AblationSystem {
  const systems::System& system;
  const systems::SystemTraining& training;
  Device device = {};
};

/// How far a row is on one split with one seed.
enum class RowState {
  kToTrain,     ///< No run exists.
  kToResume,    ///< Its training was interrupted.
  kToEvaluate,  ///< Trained; its report is missing, or was made with other options or weights.
  kDone,        ///< Complete; of an ablation that does not evaluate, the training.
};

/// The runs and reports of an ablation on disk: DIRECTORY/SPLIT/seedN/ROW/{run,report,measured.json}. measured.json is
/// written last; it holds the options and weights of the report, by which a finished evaluation is recognised.
class AblationRuns {
 public:
  /// Resolves the config and the evaluation of every row. All arguments but the directory have to outlive it.
  /// @throws UsageError as systems::System::resolve_config and resolve_evaluation, naming the row.
  AblationRuns(const Ablation& ablation, const AblationSystem& system, const std::filesystem::path& directory);

  /// A row with a split and a seed.
  struct Cell {
    const AblationRow& row;
    std::string split;
    uint64_t seed;

    std::string Describe() const { return fmt::format("{} ({}, seed {})", row.name(), split, seed); }
  };

  /// @throws UsageError if an existing run has another config or other data.
  RowState State(const Cell& cell) const;
  /// Trains what is not trained. @throws what systems::SystemTraining::train throws.
  void Train(const Cell& cell, FolderCache& databases, const Task& task) const;
  /// Evaluates the row, whose run and references have to be trained, and measures its speed; nothing if the ablation
  /// does not evaluate.
  void Evaluate(const Cell& cell, FolderCache& databases, const Task& task) const;

  /// The folder of the row's run, its own or another row's.
  std::filesystem::path Run(const Cell& cell) const;
  /// Of the row's report, its own or another row's; the row has to be done.
  Json Metrics(const Cell& cell) const;
  reports::MetricTable Table(const Cell& cell) const;
  /// Absent if the report has none: it is of an earlier version.
  std::optional<reports::Predictions> Predictions(const Cell& cell) const;
  /// The result of a row that is done: of its report, or its least validation error.
  AblationResult Result(const Cell& cell) const;
  /// The rows of the row's report that need no training; none if there is no report.
  std::vector<AblationResult> Baselines(const Cell& cell) const;

 private:
  std::filesystem::path Folder(const Cell& cell) const;
  Cell CellOf(const Cell& cell, const std::string& row) const;
  /// The row whose report is read: the row itself, or another one.
  Cell Reported(const Cell& cell) const;
  Json Config(const Cell& cell) const;
  /// Whether the training of that config is finished. @throws UsageError as State.
  bool Finished(const std::filesystem::path& run, const Json& config) const;
  /// The evaluation's options with run folders in place of row names.
  Json Eval(const Cell& cell) const;
  /// Options and weights of the report.
  Json MadeOf(const Cell& cell) const;
  /// `made_of` of measured.json; options that are newer than the file have their defaults.
  Json RecordedMadeOf(const Json& measured, const Cell& cell) const;
  RunCost Cost(const Cell& cell) const;
  AblationMeasure Validation(const Cell& cell) const;

  const Ablation& ablation_;
  const AblationSystem system_;
  std::filesystem::path directory_;
};

/// Total training time across resumes (train::ReadMetrics), in seconds.
double TrainSeconds(const std::filesystem::path& run);

/// A number of a run while it trained, of metrics.jsonl.
struct RunCurve {
  std::vector<double> steps, errors;
  std::vector<double> seconds;  ///< Of training until then, across resumes.
};
/// phase: "validation" or "train".
RunCurve ReadCurve(const std::filesystem::path& run, const std::string& phase, const std::string& metric);
/// The least error within that time; nothing before the first validation.
std::optional<double> LeastWithin(const RunCurve& curve, double seconds);

}  // namespace daumier::ablation
