#pragma once
#include "core/folder_cache.h"
#include "systems/system.h"

namespace daumier::sketch {

/// `daumier train` of a parser of drawings: opens faces and sketches, splits by person, trains, and leaves a run folder
/// that LoadParserRun reads. @throws UsageError as ParseOptions and train::OpenRunFolder, Error as Train and the
/// databases, or if the sketches are of other faces.
TrainingSummary TrainParser(const Json& config, const systems::RunPlace& place, FolderCache& databases,
                            const Task& task);

}  // namespace daumier::sketch
