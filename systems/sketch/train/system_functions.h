#pragma once
#include "core/folder_cache.h"
#include "core/task.h"
#include "systems/system.h"

#include <filesystem>
#include <string>

/// Functions of the sketch networks' row in the tables of systems (systems/system.h), which have their contracts there.
namespace daumier::sketch {

Json ResolveTraining(const Json& config, const std::string& where);
Json ResolveEvaluation(const Json& options, const std::string& where);
/// TrainSketch. The task does not reach the trainer yet: Ctrl-C stops it.
TrainingSummary Train(const Json& config, const systems::RunPlace& place, FolderCache& databases, const Task& task);
/// EvaluateSketchRun with SketchEvalOptions.
reports::Evaluation Evaluate(const std::filesystem::path& run, const Json& options, FolderCache& databases,
                             const Task& task);
/// Of the network alone, without the recovery of curve coefficients.
double InferMs(const std::filesystem::path& run);

}  // namespace daumier::sketch
