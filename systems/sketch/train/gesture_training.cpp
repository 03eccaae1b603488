#include "systems/sketch/train/gesture_training.h"

#include "core/files.h"
#include "core/log.h"
#include "core/runtime.h"
#include "systems/open_network.h"
#include "systems/sketch/gesture_counts.h"
#include "systems/sketch/train/gesture_export.h"
#include "systems/sketch/train/gesture_recipe.h"
#include "tensor/runtime.h"
#include "train/precision.h"
#include "train/run_folder.h"
#include "train/train_run.h"

#include <torch/utils.h>

namespace daumier::sketch {
namespace {

Manifest ManifestOfGestures(const GestureTrainingOptions& options, const datasets::GestureDatabase& database,
                            const datasets::GestureSplit& split) {
  Manifest manifest{.kind = "run", .verb = "train"};
  manifest.config = train::WithoutPaths(ToJson(options));
  manifest.seed = options.seed;
  manifest.sources = database.manifest().sources;
  manifest.counts = {{"training_strokes", split.train.size()},
                     {"validation_strokes", split.validation.size()},
                     {"test_strokes", split.test.size()}};
  manifest.details = {{"system", kGestureSystem}, {"data", {{"gestures", DataHash(database.directory())}}}};
  return manifest;
}

/// The threshold for the best weights of a run.
GestureRejection RejectionOfRun(const std::filesystem::path& run, const GestureTrainingOptions& options,
                                const datasets::GestureDatabase& database, const std::vector<int>& validation) {
  const GestureRecogniser recogniser({options.network, {}}, systems::OpenNetwork(run, {}));
  std::vector<double> probabilities;
  for (const int index : validation)
    if (const datasets::LabelledStroke stroke = database.stroke(index); stroke.gesture != datasets::Gesture::kNone)
      probabilities.push_back(recogniser.Recognise(stroke.points).probability);
  return ChooseRejection(std::move(probabilities), options.rejection.accepted);
}

void StoreRejection(const std::filesystem::path& run, const GestureRejection& rejection) {
  Manifest manifest = ReadManifest(run, "run");
  manifest.details["rejection"] = RejectionToJson(rejection);
  WriteManifest(run, manifest);
}

}  // namespace

TrainingSummary TrainGestures(const Json& config, const systems::RunPlace& place, FolderCache& databases,
                              const Task& task) {
  const std::filesystem::path& run_directory = place.directory;
  auto options = ParseTraining<GestureTrainingOptions>(config, "training config");
  const torch::Device torch_device = tensor::TorchDevice(place.device);
  options.trainer.precision =
      train::ResolvePrecision(options.trainer.precision, run_directory, torch_device, HasBfloat16Instructions());
  const auto& database = databases.Open<datasets::GestureDatabase>(options.data.gestures);
  const datasets::GestureSplit split =
      datasets::SplitByHand(database, options.split.validation, options.split.test, options.seed);

  const Manifest manifest = ManifestOfGestures(options, database, split);
  train::StartRun(run_directory, place.resume, {ToJson(options), ToJson(GestureTrainingOptions()), manifest});

  torch::manual_seed(options.seed);
  GestureRecipe recipe(options, database, split, torch_device);
  TrainingSummary summary =
      train::TrainRun(recipe, options.trainer, options.optimiser, options.seed, run_directory, task);
  exporting::StoreGraph(DescribeGestureExport(run_directory));
  const GestureRejection rejection = RejectionOfRun(run_directory, options, database, split.validation);
  StoreRejection(run_directory, rejection);
  log::Info("Best validation: {:.2f} % of the strokes wrong after epoch {} of {}; threshold {:.4f}; run folder {}",
            summary.best, summary.best_epoch, summary.epochs, rejection.threshold, run_directory.string());
  return summary;
}

}  // namespace daumier::sketch
