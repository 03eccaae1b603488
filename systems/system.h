#pragma once
#include "core/device.h"
#include "core/folder_cache.h"
#include "core/json.h"
#include "core/task.h"
#include "core/training.h"
#include "reports/evaluation.h"
#include "systems/picture_content.h"
#include "systems/predictor.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace daumier::exporting {
struct RunExport;  // export/run_export.h, of the training library.
struct NetworkFunction;
}  // namespace daumier::exporting

/// The one interface of a trainable task. `train`, `eval`, `ablate`, `predict` and `export` access a system through its
/// row in a table; no verb compares names.
namespace daumier::systems {

/// Where a training runs.
struct RunPlace {
  std::filesystem::path directory;
  bool resume = false;
  Device device = {};
};

/// The part of a task that needs no LibTorch. One row a task; a room may hold several.
struct System {
  std::string_view name;  ///< `system` in a config, details.system in the manifest of a run.
  std::string_view room;  ///< "systems/sketch"
  /// Help of all options of a training, and of an evaluation.
  std::string (*training_help)();
  std::string (*evaluation_help)();
  /// The whole config of a training, every option present, data folders absolute. `where` names it in messages.
  /// @throws UsageError as ParseOptions.
  Json (*resolve_config)(const Json& config, const std::string& where);
  /// Options of an evaluation, every one present. @throws UsageError as ParseOptions.
  Json (*resolve_evaluation)(const Json& options, const std::string& where);
  /// The table of a report in millimetres, from its metrics.json, also that of an earlier version. It has a column for
  /// each of summary_columns. @throws Error if it is malformed.
  reports::MetricTable (*read_metrics)(const Json& metrics);
  /// What a table of several runs shows besides their errors.
  std::vector<reports::Metric> (*summary_columns)();
  /// Options of an evaluation that are run folders, and name rows in an ablation's config.
  std::vector<std::string> run_options = {};
  /// Options of a prediction, every one present; null if the task has no predictor, as the two below.
  Json (*resolve_prediction)(const Json& options, const std::string& where) = nullptr;
  /// A finished run or shipped weights, ready to predict. @throws Error as ReadFinishedRun, ReadWeights and
  /// LoadTrainingLibrary.
  std::unique_ptr<Predictor> (*open)(const std::filesystem::path& run, const Device& device,
                                     const Json& options) = nullptr;
  /// The inputs of a file, in order. @throws Error naming it.
  std::vector<Input> (*read_inputs)(const std::filesystem::path& file) = nullptr;
  /// Of the files of a folder that is given as input: ".svg", in lower case.
  std::vector<std::string> input_extensions = {};
  /// Where no run is named, of the shipped weights that read the inputs those of the task of the largest rank are used.
  int shipped_rank = 0;
  /// What the pictures among its inputs show: where no run is named and weights of several tasks read a picture, those of
  /// the task that it suits are used.
  PictureContent picture_content = {};
  /// What a result NAME may consist of: NAME.obj and so on.
  std::vector<std::string> result_files = {".obj", ".mtl", ".png", ".svg"};
};

/// The part that needs LibTorch, by the same name, from the training library.
struct SystemTraining {
  std::string_view name;
  /// Trains from a config, or resumes. @throws UsageError as System::resolve_config; Cancelled after a checkpoint.
  /// Opens databases by `databases`.
  TrainingSummary (*train)(const Json& config, const RunPlace& place, FolderCache& databases, const Task& task);
  /// Measures a finished run; writes nothing (reports::WriteEvaluation does). Opens databases by `databases`.
  reports::Evaluation (*evaluate)(const std::filesystem::path& run, const Json& options, FolderCache& databases,
                                  const Task& task);
  /// The export of a finished run.
  exporting::RunExport (*describe_export)(const std::filesystem::path& run);
  /// Milliseconds from one input to its vertices: the median of many runs with batch 1 on the CPU.
  double (*infer_ms)(const std::filesystem::path& run);
  std::string_view validation_metric;     ///< The validation error in metrics.jsonl, mm.
  std::string_view training_metric = "";  ///< An error of training samples there; empty: none.
  /// The network of shipped weights, with any numbers in it, from `network` of their details; null: there are none.
  exporting::NetworkFunction (*make_network)(const Json& network) = nullptr;
};

}  // namespace daumier::systems
