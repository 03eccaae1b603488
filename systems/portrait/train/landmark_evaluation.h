#pragma once
#include "core/folder_cache.h"
#include "core/task.h"
#include "reports/evaluation.h"
#include "systems/portrait/landmark_evaluation_options.h"

#include <filesystem>

namespace daumier::portrait {

/// Measures a finished run on unseen portraits, and on given pictures with and without faces.
/// Rows: the whole detector; with the true box given; that before eyes are snapped; and as baseline the mean shape of
/// training portraits in the true box. metrics.json also holds intersection over union of classes, wrong states, the error of each skin tone
/// and their spread (largest less smallest over their mean), `pictures` (found, median and mean error, eyes, milliseconds,
/// the same of a rival, each picture) and `negatives` (false faces at several thresholds).
/// @throws Error as LoadLandmarkRun and FindRunData; UsageError if the side of the split is empty.
reports::Evaluation EvaluateLandmarks(const std::filesystem::path& run_directory, const LandmarkEvalOptions& options,
                                      FolderCache& databases, const Task& task);

}  // namespace daumier::portrait
