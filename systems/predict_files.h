#pragma once
#include "core/json.h"
#include "systems/predict_inputs.h"
#include "systems/predictor.h"
#include "systems/system.h"

#include <filesystem>
#include <vector>

namespace daumier::systems {

/// What became of a prediction.
struct PredictionSummary {
  size_t num_results = 0;
  std::vector<PredictionFailure> failures;  ///< Of reading and of predicting.
};

/// `daumier predict`: for every input a mesh NAME.obj (where the result has one), a sheet NAME.png of input, front and
/// side, of drawings also the strokes on the canvas NAME.svg, the files and masks of the result, and a manifest
/// (PredictionFolder). details.drawings.NAME holds the record of each result and the name of its input's file; a record
/// of another run or other options than the manifest's has its own `options` and `run_data_hash`.
/// `options`: of the predictor, every one present, for the manifest. Progress is that of the inputs, not the
/// predictor's own.
/// An input that fails spoils only itself. Nothing is written if there is no result.
/// @throws Error as CheckPredictionFolder; Cancelled if the task is.
PredictionSummary PredictFiles(const System& system, const Predictor& predictor, const std::filesystem::path& run,
                               const PredictionInputs& inputs, const std::filesystem::path& out_directory,
                               const Json& options, const Task& task = {});

/// @throws Error with the causes if there is a failure: that of a single input alone, else a line each, and where the
/// results of the others are.
void ThrowIfFailed(const PredictionSummary& summary, const std::filesystem::path& out_directory);

}  // namespace daumier::systems
