#include "systems/portrait/train/landmark_training.h"

#include "core/config.h"
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
#include "train/run_folder.h"
#include "train/trainer.h"

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
  const Json defaults = ToJson(LandmarkTrainingOptions());
  if (place.resume) train::LengthenFinishedRun(run_directory, manifest.config, manifest.details["data"], defaults);
  const bool begun =
      train::OpenRunFolder(run_directory, place.resume, manifest.config, manifest.details["data"], defaults);
  if (begun) VerifyChecksums(run_directory, ReadManifest(run_directory, "run"));
  WriteFileIfChanged(run_directory / "resolved.toml", ToToml(ToJson(options)));
  if (!begun) WriteManifest(run_directory, manifest);

  torch::manual_seed(options.seed);
  LandmarkRecipe recipe(options, source, split.train, split.validation, torch_device);
  const int64_t num_parameters = recipe.network()->num_parameters();
  log::Info("Training {} parameters on {} portraits", num_parameters, recipe.num_samples());
  TrainingSummary summary = train::Train(recipe, options.trainer, options.optimiser, options.seed, run_directory, task,
                                         train::EarlierTrainings(run_directory));
  train::FinishRun(run_directory, summary, num_parameters);
  exporting::StoreGraph(DescribeLandmarkExport(run_directory));
  log::Info("Best validation: {:.2f} % of the eye distance after epoch {} of {}; run folder {}", summary.best,
            summary.best_epoch, summary.epochs, run_directory.string());
  return summary;
}

}  // namespace daumier::portrait
