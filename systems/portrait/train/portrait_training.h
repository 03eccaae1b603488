#pragma once
#include "core/folder_cache.h"
#include "systems/system.h"

namespace daumier::portrait {

/// `daumier train` of a portrait network: opens the databases, splits by person, fits the 3DMM, trains and leaves a run
/// folder that LoadPortraitRun reads. The manifest holds the split, the hashes of the data and their licences, and no
/// path. @throws UsageError as ParseOptions and train::OpenRunFolder, Error as Train, ModelOfTraining and the databases,
/// and if the portraits show other faces or other expressions.
TrainingSummary TrainPortrait(const Json& config, const systems::RunPlace& place, FolderCache& databases,
                              const Task& task);

}  // namespace daumier::portrait
