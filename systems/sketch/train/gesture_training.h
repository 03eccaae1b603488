#pragma once
#include "core/folder_cache.h"
#include "systems/system.h"

namespace daumier::sketch {

/// `daumier train` of a classifier of gestures: opens the strokes, splits by hand, trains, chooses the threshold of
/// rejection on the validation strokes, and leaves a run folder that LoadGestureRun and OpenGestureRecogniser read.
/// @throws UsageError as ParseOptions and train::OpenRunFolder, Error as Train, GestureDatabase and SplitByHand.
TrainingSummary TrainGestures(const Json& config, const systems::RunPlace& place, FolderCache& databases,
                              const Task& task);

}  // namespace daumier::sketch
