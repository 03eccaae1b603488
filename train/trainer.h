#pragma once
#include "train/optimiser.h"
#include "train/recipe.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace daumier::train {

/// The one loop. Trains the recipe's network, from the last checkpoint in `run_directory` if there is one, and leaves
/// there:
///   metrics.jsonl, TensorBoard events   means over log_every steps of the loss and its parts, gradient_norm and
///                                        learning_rate; validation
///   checkpoints/latest/                  after every validation, see train/checkpoint.h
///   best/model.safetensors               the weights whose validation metric was least, the first of equals; weights
///                                        are validated after every validate_every epochs and the last one
/// A step averages the gradients of `accumulate` batches. A loader thread reads the next batches while a step computes.
/// Numbers of steps are summed on the device. On a GPU they are read, and checked to be finite, where a line or a
/// checkpoint is written; on a CPU after every step.
/// The recipe's stages follow each other. In each the optimiser starts again, with the learning rate of LearningRate
/// over the steps of the stage. Patience counts in the last stage alone.
/// The order of the samples of an epoch depends on (seed, epoch) alone, and all else that matters is in the checkpoint:
/// a resumed training ends with the same bytes as an uninterrupted one, on as many threads. A checkpoint resumes on any
/// device; there the bytes differ.
/// @throws Error if a loss or a gradient is not a number (the samples of its step are in nan_batch.safetensors, the
/// message names the step), what Recipe::Read throws, and on Ctrl-C, after a checkpoint, the command that resumes.
TrainingSummary Train(Recipe& recipe, const TrainerOptions& options, const OptimiserOptions& optimiser_options,
                      uint64_t seed, const std::filesystem::path& run_directory);

}  // namespace daumier::train
