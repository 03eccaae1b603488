#pragma once
#include "core/manifest.h"
#include "core/task.h"
#include "core/training.h"
#include "train/recipe.h"

#include <cstdint>
#include <filesystem>

/// What every task's training does before and after its own part.
namespace daumier::train {

/// A run as its training begins: what OpenRunFolder compares, and the first files of its folder.
struct RunStart {
  Json options;       ///< All options of the training: resolved.toml.
  Json defaults;      ///< The same without a config, for runs that are older than an option.
  Manifest manifest;  ///< `config`: the options WithoutPaths; details.data: the hash of every database.
};

/// Begins a run in `directory`, or resumes the one there, of which a finished one may get longer (LengthenFinishedRun):
/// afterwards resolved.toml and the manifest are there. Returns whether the run had begun before.
/// @throws UsageError as OpenRunFolder; Error as VerifyChecksums.
bool StartRun(const std::filesystem::path& directory, bool resume, const RunStart& start);

/// Trains the recipe in the folder of StartRun, as Train, and notes its end in the manifest (FinishRun), with the number
/// of parameters of the recipe's product.
TrainingSummary TrainRun(Recipe& recipe, const TrainerOptions& trainer, const OptimiserOptions& optimiser,
                         uint64_t seed, const std::filesystem::path& directory, const Task& task = {});

int64_t NumParameters(const torch::nn::Module& module);

}  // namespace daumier::train
