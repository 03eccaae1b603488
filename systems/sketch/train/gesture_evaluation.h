#pragma once
#include "core/folder_cache.h"
#include "core/task.h"
#include "reports/evaluation.h"
#include "systems/sketch/gesture_evaluation_options.h"

#include <filesystem>

namespace daumier::sketch {

/// Measures a finished run, with its threshold of rejection, on strokes of hands that were not trained on, or of an
/// independent generator. metrics.json holds GestureCounts, `at_accepted` (the share of other strokes rejected, if the
/// threshold were chosen on the measured gestures), milliseconds a stroke (median, the picture included), and with
/// `drawings` in `drawings` the same of their strokes, with the numbers of those that do not count (nearly_straight,
/// nearly_closed, points).
/// @throws Error as ReadGestureDecision, GestureDatabase, FindRunData and render::ReadDrawings, UsageError if there is no
/// stroke to measure.
reports::Evaluation EvaluateGestures(const std::filesystem::path& run_directory, const GestureEvalOptions& options,
                                     FolderCache& databases, const Task& task);

}  // namespace daumier::sketch
