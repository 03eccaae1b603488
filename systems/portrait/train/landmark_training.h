#pragma once
#include "core/folder_cache.h"
#include "systems/system.h"

namespace daumier::portrait {

/// `daumier train` of a landmark network: opens the portraits, splits by person, trains, and leaves a run folder that
/// LoadLandmarkRun reads. The manifest holds the split, the hash of the portraits and their licences, and no path.
/// @throws UsageError as ParseOptions and train::OpenRunFolder, Error as Train and the database.
TrainingSummary TrainLandmarks(const Json& config, const systems::RunPlace& place, FolderCache& databases,
                               const Task& task);

}  // namespace daumier::portrait
