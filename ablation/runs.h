#pragma once
#include "ablation/config.h"
#include "ablation/table.h"
#include "ablation/task.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace daumier::ablation {

/// How far a row is on one split with one seed.
enum class RowState {
  kToTrain,     ///< Nothing is there.
  kToGoOn,      ///< Its training was stopped.
  kToEvaluate,  ///< Trained; its report is missing, or was made with other options or weights.
  kDone,        ///< All is there; of an ablation that does not evaluate, the training.
};

/// The runs and reports of an ablation on disk: DIRECTORY/SPLIT/seedN/ROW/{run,report,measured.json}. measured.json is
/// written last and holds what the report was made of; it is how a finished evaluation is known again.
class AblationRuns {
 public:
  /// Resolves the config and the evaluation of every row. All arguments but the directory have to outlive it.
  /// @throws UsageError as AblationTask::ResolvedConfig and ResolvedEval, naming the row.
  AblationRuns(const Ablation& ablation, const AblationTask& task, const std::filesystem::path& directory);

  /// A row with a split and a seed.
  struct Place {
    const AblationRow& row;
    std::string split;
    uint64_t seed;

    std::string Describe() const { return fmt::format("{} ({}, seed {})", row.name(), split, seed); }
  };

  /// @throws UsageError if a run is there that has another config or other data.
  RowState State(const Place& place) const;
  /// Trains what is not trained. @throws Error as AblationTask::Train.
  void Train(const Place& place) const;
  /// Evaluates the row, whose run and references have to be trained, and measures its speed; nothing if the ablation
  /// does not evaluate.
  void Evaluate(const Place& place) const;

  /// Where the row's run is, be it its own or another row's.
  std::filesystem::path Run(const Place& place) const;
  /// metrics.json of the row's report, be it its own or another row's; the row has to be done.
  Json Metrics(const Place& place) const;
  /// What the table tells of a row that is done: its report, or its least validation error.
  AblationResult Result(const Place& place) const;
  /// The lines of the row's report that need no training; none if there is no report.
  std::vector<AblationResult> Baselines(const Place& place) const;
  /// For a sheet.
  AblationPicture Picture(const Place& place) const;

 private:
  std::filesystem::path Folder(const Place& place) const;
  Place PlaceOf(const Place& place, const std::string& row) const;
  /// Whose report the row is read from: its own, or another row's.
  Place Reported(const Place& place) const;
  Json Config(const Place& place) const;
  /// The evaluation's options with run folders in the place of rows.
  Json Eval(const Place& place) const;
  /// What a report is made of: equal unless it has to be made anew.
  Json Made(const Place& place) const;
  RunCost Cost(const Place& place) const;
  AblationMeasure Validation(const Place& place) const;

  const Ablation& ablation_;
  const AblationTask& task_;
  std::filesystem::path directory_;
  std::vector<std::string> references_;
};

/// Total training time across resumes (train::ReadMetrics), in seconds.
double TrainSeconds(const std::filesystem::path& run);

/// A number of a run while it trained, as metrics.jsonl tells it.
struct RunCurve {
  std::vector<double> steps, errors;
  std::vector<double> seconds;  ///< Of training until then, through stops.
};
/// phase: "validation" or "train".
RunCurve ReadCurve(const std::filesystem::path& run, const std::string& phase, const std::string& metric);
/// The least error within so many seconds; nothing before the first.
std::optional<double> LeastWithin(const RunCurve& curve, double seconds);

}  // namespace daumier::ablation
