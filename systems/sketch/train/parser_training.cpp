#include "systems/sketch/train/parser_training.h"

#include "core/error.h"
#include "core/files.h"
#include "core/log.h"
#include "core/runtime.h"
#include "datasets/read/run_data.h"
#include "systems/sketch/parser_run_folder.h"
#include "systems/sketch/train/parser_export.h"
#include "systems/sketch/train/parser_recipe.h"
#include "systems/sketch/train/training.h"
#include "tensor/runtime.h"
#include "train/precision.h"
#include "train/train_run.h"

#include <torch/utils.h>

namespace daumier::sketch {

TrainingSummary TrainParser(const Json& config, const systems::RunPlace& place, FolderCache& databases,
                            const Task& task) {
  const std::filesystem::path& run_directory = place.directory;
  auto options = ParseTraining<ParserTrainingOptions>(config, "training config");
  const torch::Device torch_device = tensor::TorchDevice(place.device);
  options.trainer.precision =
      train::ResolvePrecision(options.trainer.precision, run_directory, torch_device, HasBfloat16Instructions());
  const auto& faces = databases.Open<faces::FaceDatabase>(options.data.faces);
  const auto& sketches = databases.Open<datasets::SketchDatabase>(options.data.sketches);
  const datasets::Split split = datasets::MakeSplit(faces, options.split, options.seed);

  Manifest manifest = datasets::ManifestOfTraining(ToJson(options), options.seed, faces, split);
  manifest.details["data"] = DataHashes(options.data.faces, options.data.sketches, sketches);
  const datasets::SketchDatabase* profiles = nullptr;
  if (options.data.profiles != kNoData) {
    profiles = &databases.Open<datasets::SketchDatabase>(options.data.profiles);
    manifest.details["data"]["profiles"] =
        DataHashes(options.data.faces, options.data.profiles, *profiles).at("sketches");
  }
  manifest.details["system"] = kParserSystem;
  train::StartRun(run_directory, place.resume, {ToJson(options), ToJson(ParserTrainingOptions()), manifest});

  torch::manual_seed(options.seed);
  ParserRecipe recipe(options, {sketches, profiles}, split.train, split.validation, torch_device);
  TrainingSummary summary =
      train::TrainRun(recipe, options.trainer, options.optimiser, options.seed, run_directory, task);
  exporting::StoreGraph(DescribeParserExport(run_directory));
  log::Info("Best validation: {:.2f} % of the eye distance after epoch {} of {}; run folder {}", summary.best,
            summary.best_epoch, summary.epochs, run_directory.string());
  return summary;
}

}  // namespace daumier::sketch
