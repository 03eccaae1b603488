#pragma once
#include "core/folder_lock.h"
#include "core/manifest.h"
#include "core/output_place.h"
#include "systems/predict_inputs.h"
#include "systems/system.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace daumier::systems {

/// A folder of predictions.
OutputKind PredictionOutput();

/// @throws UsageError as CheckOutputFolder, if an input lies in `out_directory`, if that holds predictions of another
/// task, if a file of a result would have a longer name than files can have, or if a file in the folder would be lost
/// that is no result of an earlier prediction (CheckOwnFiles).
void CheckPredictionFolder(const System& system, const std::filesystem::path& out_directory,
                           const std::filesystem::path& run, const PredictionInputs& inputs);

/// Of a folder of predictions, while a command adds its results. From the first result on it is locked (FolderLock), so
/// that several commands can name one folder; before that it is not touched. The manifest (kind "predictions") is
/// written before and after each result: what is finished when the program ends is whole, and what is not is listed as
/// kUnfinishedFiles. Results of earlier predictions stay, and stay listed.
class PredictionFolder {
 public:
  /// What is written: `directory`, by `run` and `options`, from `inputs`; `task` stops the waiting for its lock.
  /// `system` and `inputs` must outlive the object. @throws Error as CheckPredictionFolder.
  PredictionFolder(const System& system, std::filesystem::path directory, const std::filesystem::path& run,
                   const Json& options, const PredictionInputs& inputs, const Task& task);

  /// Writes files into an empty folder and returns their names.
  using Writer = std::function<std::vector<std::string>(const std::filesystem::path&)>;

  /// Adds a result, whole or not at all: if `write` fails, an earlier result of that name is as it was, and a folder that
  /// was not there is gone again. `failures`: so far, {file, cause} each in details.failures.
  /// @throws what `write` throws; Error as CheckPredictionFolder and FolderLock.
  void Add(const PredictionInput& input, const Json& record, const std::vector<PredictionFailure>& failures,
           const Writer& write);

  /// Lists all failures, where a result was added.
  void Finish(const std::vector<PredictionFailure>& failures);

 private:
  void Begin();
  void ListFailures(const std::vector<PredictionFailure>& failures);
  void WriteManifestNow();
  std::vector<std::string> Staged(const Writer& write);
  /// After a failed `write`: as the folder was before.
  void Restore(const Manifest& before);

  const System& system_;
  const std::filesystem::path directory_, run_;
  const PredictionInputs& inputs_;
  const Task task_;
  const bool was_absent_;
  bool has_earlier_ = false;  ///< Results, when it was locked.
  size_t num_results_ = 0;
  std::optional<FolderLock> lock_;
  Manifest manifest_;
  std::set<std::string> unfinished_;
};

}  // namespace daumier::systems
