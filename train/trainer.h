#pragma once
#include "core/task.h"
#include "train/optimiser.h"
#include "train/recipe.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace daumier::train {

/// A finished training of a run that a longer one continues.
struct EarlierTraining {
  int64_t planned_epochs = 0;  ///< Of its config; its stages are shares of their steps.
  int64_t epochs = 0;          ///< Finished ones: fewer if it stopped early.
};

/// Trains the recipe's network, from the last checkpoint in `run_directory` if there is one, and writes there
///   metrics.jsonl, TensorBoard events   training terms as means over log_every steps, learning_rate, gradient_norm;
///                                       validation
///   checkpoints/latest/                 after every validation, see train/checkpoint.h
///   best/model.safetensors              the weights whose validation metric was least, the first of equals; weights
///                                       are validated after every validate_every epochs and the last one
/// The recipe's stages follow each other; the optimiser is reset at the start of each, with the learning rate of
/// LearningRate over the steps of the stage. Patience counts in the last stage alone.
/// `earlier` trainings have the recipe's stages, in the first of them; every later one and this one continue the last
/// stage that had a step, as a stage of their own: it begins with a reset optimiser and its own warm-up.
/// The order of the samples of an epoch depends on (seed, epoch) alone, and all else that matters is in the checkpoint:
/// a training that was interrupted anywhere and resumed ends with the same bytes as an uninterrupted one, given the
/// same number of threads.
/// @throws Error if a loss or a gradient is not a number (the batch is in nan_batch.safetensors, the message says
/// where); Cancelled, after a checkpoint, with the command that resumes.
TrainingSummary Train(Recipe& recipe, const TrainerOptions& options, const OptimiserOptions& optimiser_options,
                      uint64_t seed, const std::filesystem::path& run_directory, const Task& task = {},
                      const std::vector<EarlierTraining>& earlier = {});

}  // namespace daumier::train
