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

/// What differs between two configs, a line a dotted key: "optimiser.learning_rate is 0.001 there and 0.01 now". A key
/// that is missing there counts as its value in `defaults`.
std::vector<std::string> ConfigDifferences(const Json& there, const Json& now, const Json& defaults = Json::object());

/// Makes `directory` ready for a run. Returns false if the run is to be started and true if it is to be gone on with,
/// which is where its manifest is. `config` (without paths) and `data` (the hash of every database) are what the
/// manifest must then hold as `config` and `details.data`; options that are newer than the run count as in `defaults`.
/// @throws UsageError if a run is there but `resume` is not asked for, if `resume` is but nothing is there, or if the
/// run there has another config or other data, saying what differs.
bool OpenRunFolder(const std::filesystem::path& directory, bool resume, const Json& config, const Json& data,
                   const Json& defaults = Json::object());

/// Says in the manifest of the run there how the training ended: parameters, steps, epochs, best epoch, the checksum of
/// kBestFile. A run is finished once it holds `best_epoch`.
void FinishRun(const std::filesystem::path& directory, const TrainingSummary& summary, int64_t num_parameters);

}  // namespace daumier::train
