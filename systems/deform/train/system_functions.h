#pragma once
#include "core/folder_cache.h"
#include "core/task.h"
#include "systems/system.h"

#include <filesystem>
#include <string>

/// Functions of the deformable model's row in the tables of systems (systems/system.h), which have their contracts there.
namespace daumier::deform {

Json ResolveTraining(const Json& config, const std::string& where);
Json ResolveEvaluation(const Json& options, const std::string& where);
/// TrainDeform. The task does not reach the trainer yet: Ctrl-C stops it.
TrainingSummary Train(const Json& config, const systems::RunPlace& place, FolderCache& databases, const Task& task);
/// EvaluateDeformRun with DeformEvalOptions.
reports::Evaluation Evaluate(const std::filesystem::path& run, const Json& options, FolderCache& databases,
                             const Task& task);
/// From a code to all vertices, including the layers that depend on the code.
double InferMs(const std::filesystem::path& run);

}  // namespace daumier::deform
