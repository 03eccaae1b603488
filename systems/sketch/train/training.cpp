#include "systems/sketch/train/training.h"

#include "core/config.h"
#include "core/error.h"
#include "core/files.h"
#include "core/log.h"
#include "core/runtime.h"
#include "datasets/read/run_data.h"
#include "datasets/read/training_fit.h"
#include "render/camera_json.h"
#include "systems/sketch/options.h"
#include "systems/sketch/train/export.h"
#include "systems/sketch/train/recipe.h"
#include "systems/sketch/train/run.h"
#include "tensor/runtime.h"
#include "train/precision.h"
#include "train/run_folder.h"
#include "train/trainer.h"

#include <torch/utils.h>

namespace daumier::sketch {
namespace {

namespace fs = std::filesystem;

/// The models of a run: fitted and written with all else that begins a run folder, or read back from it.
FittedModels BeginRun(const fs::path& directory, const SketchTrainingOptions& options, Manifest manifest,
                      const faces::FaceDatabase& faces, const datasets::SketchDatabase& sketches,
                      const datasets::Split& split, const Task& task) {
  log::Info("Fitting the bilinear models on {} training faces", split.train.size());
  const datasets::FittedBilinear bilinear = datasets::FitOnTraining(faces, split, options.bilinear, task),
                                 curves = datasets::FitCurvesOnTraining(faces, sketches, split, options.bilinear, task);
  FittedModels models{
      bilinear.model, curves.model, {}, datasets::FitGaussianOnTraining(faces, split, options.gaussian, task)};
  if (options.network.residual > 0) {
    models.basis =
        options.network.basis == "gaussian"
            ? datasets::GaussianBasisOnTraining(faces, split, bilinear.model, models.gaussian, options.seed, task)
            : datasets::FitBasisOnTraining(faces, split, bilinear.model, options.network.residual, options.seed, task);
  }
  // Only now does the folder hold a run: options that the fit refuses can be corrected in the same folder.
  WriteFileAtomically(directory / "resolved.toml", ToToml(ToJson(options)));
  manifest.details["bilinear"] = bilinear.proof;
  manifest.details["curves"] = curves.proof;
  manifest.checksums = faces::WriteFaceTemplate(directory, faces.face_template());
  manifest.checksums.merge(WriteFittedModels(directory, models));
  WriteManifest(directory, manifest);
  return models;
}

FittedModels ResumeRun(const fs::path& directory, const SketchTrainingOptions& options) {
  VerifyChecksums(directory, ReadManifest(directory, "run"));
  WriteFileIfChanged(directory / "resolved.toml", ToToml(ToJson(options)));  // The data may have moved.
  return ReadFittedModels(directory);
}

/// How the sketches were seen.
Json SketchFrame(const datasets::SketchDatabase& sketches) {
  std::vector<std::string> names;
  for (const int curve : sketches.feature_curves()) names.push_back(sketches.curve_names()[size_t(curve)]);
  return {{"camera", render::CameraToJson(sketches.camera())}, {"feature_curves", names}};
}

}  // namespace

Json DataHashes(const std::string& faces, const std::string& sketches_folder,
                const datasets::SketchDatabase& sketches) {
  const std::string faces_hash = DataHash(faces);
  DAUMIER_CHECK(sketches.manifest().details.value("faces_data_hash", "") == faces_hash,
                "{} are sketches of other faces than {}: make them again with `daumier dataset sketches`",
                sketches_folder, faces);
  return {{"faces", faces_hash}, {"sketches", DataHash(sketches_folder)}};
}

TrainingSummary TrainSketch(const Json& config, const systems::RunPlace& place, FolderCache& databases,
                            const Task& task) {
  const fs::path& run_directory = place.directory;
  SketchTrainingOptions options = ParseTraining<SketchTrainingOptions>(config, "training config");
  RequireWholeBlocks(options.network);
  const torch::Device torch_device = tensor::TorchDevice(place.device);
  options.trainer.precision =
      train::ResolvePrecision(options.trainer.precision, run_directory, torch_device, HasBfloat16Instructions());
  const auto& faces = databases.Open<faces::FaceDatabase>(options.data.faces);
  const auto& sketches = databases.Open<datasets::SketchDatabase>(options.data.sketches);
  const datasets::Split split = datasets::MakeSplit(faces, options.split, options.seed);

  Manifest manifest = datasets::ManifestOfTraining(ToJson(options), options.seed, faces, split);
  manifest.details["data"] = DataHashes(options.data.faces, options.data.sketches, sketches);
  manifest.details["sketches"] = SketchFrame(sketches);
  manifest.details["system"] = kSystem;

  const Json defaults = ToJson(SketchTrainingOptions());
  if (place.resume) train::LengthenFinishedRun(run_directory, manifest.config, manifest.details["data"], defaults);
  const bool begun =
      train::OpenRunFolder(run_directory, place.resume, manifest.config, manifest.details["data"], defaults);
  const FittedModels models = begun ? ResumeRun(run_directory, options)
                                    : BeginRun(run_directory, options, manifest, faces, sketches, split, task);

  torch::manual_seed(options.seed);
  SketchRecipe recipe(options, faces, sketches, split, models, torch_device);
  log::Info("Training {} parameters on {} sketches", recipe.network()->num_parameters(), recipe.num_samples());
  TrainingSummary summary = train::Train(recipe, options.trainer, options.optimiser, options.seed, run_directory, task,
                                         train::EarlierTrainings(run_directory));
  train::FinishRun(run_directory, summary, recipe.network()->num_parameters());
  exporting::StoreGraph(DescribeSketchExport(run_directory));
  log::Info("Best validation: {:.3f} mm after epoch {} of {}; run folder {}", summary.best, summary.best_epoch,
            summary.epochs, run_directory.string());
  return summary;
}

}  // namespace daumier::sketch
