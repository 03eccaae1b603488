#include "systems/portrait/train/landmark_training.h"

#include "core/error.h"
#include "core/files.h"
#include "core/log.h"
#include "core/run_manifest.h"
#include "core/runtime.h"
#include "systems/portrait/landmark_portraits.h"
#include "systems/portrait/landmark_run_folder.h"
#include "systems/portrait/landmark_split.h"
#include "systems/portrait/train/landmark_export.h"
#include "systems/portrait/train/landmark_recipe.h"
#include "tensor/runtime.h"
#include "train/precision.h"
#include "train/train_run.h"

#include <torch/utils.h>

namespace daumier::portrait {
namespace {

Manifest ManifestOfLandmarks(const LandmarkTrainingOptions& options, const datasets::PortraitDatabase& portraits,
                             const LandmarkSource& source, const datasets::Split& split) {
  Manifest manifest{.kind = "run", .verb = "train"};
  manifest.config = ToJson(options);
  manifest.config.erase("data");
  manifest.seed = options.seed;
  manifest.sources = portraits.manifest().sources;
  manifest.counts = {{"training_portraits", split.train.size()},
                     {"validation_portraits", split.validation.size()},
                     {"test_portraits", split.test.size()}};
  manifest.details = {{"system", kLandmarkSystem},
                      {"split", SampleSplitToJson(source, split)},
                      {"data", {{"portraits", DataHash(options.data.portraits)}}}};
  return manifest;
}

}  // namespace

TrainingSummary TrainLandmarks(const Json& config, const systems::RunPlace& place, FolderCache& databases,
                               const Task& task) {
  const std::filesystem::path& run_directory = place.directory;
  auto options = ParseTraining<LandmarkTrainingOptions>(config, "training config");
  const torch::Device torch_device = tensor::TorchDevice(place.device);
  options.trainer.precision =
      train::ResolvePrecision(options.trainer.precision, run_directory, torch_device, HasBfloat16Instructions());
  const auto& portraits = databases.Open<datasets::PortraitDatabase>(options.data.portraits);
  const PortraitSamples source(portraits);
  const datasets::Split split = SplitSamples(source, options.split, options.seed);

  const Manifest manifest = ManifestOfLandmarks(options, portraits, source, split);
  train::StartRun(run_directory, place.resume, {ToJson(options), ToJson(LandmarkTrainingOptions()), manifest});

  torch::manual_seed(options.seed);
  LandmarkRecipe recipe(options, source, split.train, split.validation, torch_device);
  TrainingSummary summary =
      train::TrainRun(recipe, options.trainer, options.optimiser, options.seed, run_directory, task);
  exporting::StoreGraph(DescribeLandmarkExport(run_directory));
  log::Info("Best validation: {:.2f} % of the eye distance after epoch {} of {}; run folder {}", summary.best,
            summary.best_epoch, summary.epochs, run_directory.string());
  return summary;
}

}  // namespace daumier::portrait
