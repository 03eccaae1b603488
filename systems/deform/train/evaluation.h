#pragma once
#include "core/json.h"
#include "systems/deform/evaluation_options.h"

#include <filesystem>
#include <string>

namespace daumier::deform {

/// `daumier eval` of a deformable model's run: the errors of faces whose codes are found with the network held fixed
/// (FitCode with the weights of the run's loss), over all vertices, in the model's frame, with nothing aligned
/// first. Rows: the network with codes by Gauss-Newton; both methods on the first adam_faces of the faces; the template
/// alone; the mean of the training faces, the nearest of them, and a linear model with as many components as a code has
/// numbers (eval/linear_model.h, fitted on at most 2,000 evenly spread training faces, its ridge weight chosen on
/// at most 200 validation faces). Writes into `out_directory` metrics.json (returned; docs/formats.md), table.md, a
/// report with pictures (eval/report.h) of the median, the 95th percentile and the first face, and a manifest.
/// @throws Error as LoadDeformRun and FaceDatabase, if the run's faces are not those that it was trained on, or if
/// other faces are of another topology; UsageError if the side is empty.
Json EvaluateDeformRun(const std::filesystem::path& run_directory, const std::filesystem::path& out_directory,
                       const DeformEvalOptions& options = {});

}  // namespace daumier::deform
