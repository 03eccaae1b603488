#pragma once
#include "core/json.h"
#include "core/manifest.h"
#include "core/options.h"
#include "core/run_manifest.h"
#include "train/trainer.h"

#include <filesystem>
#include <string>
#include <vector>

namespace daumier::train {

/// The options of a training as the manifest of its run records them: without `data`, `real` and the files of `source`
/// (path, annotation, template_mesh), which may lie elsewhere on another machine.
Json WithoutPaths(Json config);

/// Prepares `directory` for a run. Returns true when resuming, i.e. when manifest.json exists. The manifest must then
/// hold `config` (without paths) as `config` and `data` (the hash of every database) as `details.data`; options that
/// are newer than the run count as in `defaults`, and a precision "auto" as that of the run.
/// @throws UsageError as CheckOutputFolder, if a run exists but `resume` is false, if `resume` is true but none exists,
/// or if the run has another config or other data; the message lists the differences and, if they are the epochs, what
/// to do.
bool OpenRunFolder(const std::filesystem::path& directory, bool resume, const Json& config, const Json& data,
                   const Json& defaults = Json::object());

/// Makes a finished run, whose config differs from `config` in fewer `epochs` alone, one that is not finished: the
/// manifest takes the epochs, lists the training so far in details.earlier_trainings ({planned_epochs, epochs} each) and
/// drops its end and the checksums of best/; best/model.onnx is deleted. Any other run is unchanged: OpenRunFolder
/// then says what differs. @throws Error as VerifyChecksums.
void LengthenFinishedRun(const std::filesystem::path& directory, const Json& config, const Json& data,
                         const Json& defaults);

/// details.earlier_trainings of a run, the first one first. @throws Error if they are malformed.
std::vector<EarlierTraining> EarlierTrainings(const std::filesystem::path& directory);

/// Says in the manifest of the run there how the training ended: parameters, steps, epochs, best epoch, the checksum of
/// kBestFile. A run is finished once it holds `best_epoch`. A manifest that holds all that is not written again.
void FinishRun(const std::filesystem::path& directory, const TrainingSummary& summary, int64_t num_parameters);

}  // namespace daumier::train
