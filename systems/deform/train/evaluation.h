#pragma once
#include "core/folder_cache.h"
#include "core/task.h"
#include "reports/evaluation.h"
#include "systems/deform/evaluation_options.h"

#include <filesystem>

namespace daumier::deform {

/// `daumier eval` of a deformable model's run: the errors of faces whose codes are found with the network held fixed
/// (FitCode with the weights of the run's loss), over all vertices, in the model's frame, with nothing aligned first.
/// Rows: the network with codes by Gauss-Newton; both methods on the first adam_faces of the faces; the template alone;
/// the mean of the training faces, the nearest of them, and a linear model with as many components as a code has
/// numbers (baselines.h, fitted on at most 2,000 evenly spread training faces, its ridge weight chosen on at most 200
/// validation faces). Of an imported run other faces are measured, against the template alone. metrics: docs/formats.md. @throws Error as LoadDeformRun and FaceDatabase, if the run's faces are
/// not those that it was trained on, if other faces are of another topology, or if an error is not finite; UsageError
/// if the side is empty; Cancelled.
reports::Evaluation EvaluateDeformRun(const std::filesystem::path& run_directory, const DeformEvalOptions& options,
                                      FolderCache& databases, const Task& task = {});

}  // namespace daumier::deform
