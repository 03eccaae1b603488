#include "systems/deform/train/training.h"

#include "core/config.h"
#include "core/error.h"
#include "core/files.h"
#include "core/log.h"
#include "core/stopwatch.h"
#include "datasets/read/run_data.h"
#include "eval/principal_components.h"
#include "systems/deform/train/array_deformations.h"
#include "systems/deform/train/export.h"
#include "systems/deform/train/recipe.h"
#include "tensor/eigen.h"
#include "tensor/module_state.h"
#include "tensor/runtime.h"
#include "tensor/torch_version.h"
#include "train/run_folder.h"
#include "train/run_log.h"
#include "train/trainer.h"

#include <torch/utils.h>

namespace daumier::deform {
namespace {

namespace fs = std::filesystem;

/// The factor of the rows of a linear model, by validation; codes begin with a deviation of 0.01.
void FitLinear(DeformRecipe& recipe, const DeformTrainingOptions& options) {
  constexpr float kCodeDeviation = 0.01f;
  const at::NoGradGuard no_grad;
  auto& network = dynamic_cast<LinearDeformation&>(*recipe.decoder().network());
  const torch::Tensor faces = recipe.TrainingVertices().flatten(1);
  const eval::PrincipalComponents components = eval::FitPrincipalComponents(
      eval::Centre(tensor::CopyToMatrix<float>(faces)), options.network.latent, options.seed);
  const eval::FaceRows scaled = (components.deviations / kCodeDeviation).asDiagonal() * components.rows;
  const torch::Tensor mean = tensor::CopyToTensor(components.mean).to(faces.device()),
                      rows = tensor::CopyToTensor(scaled).to(faces.device());
  double best_error = 0, best_factor = 0;
  for (const double factor : {0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0}) {
    network.Set(mean, rows * factor);
    const double error = recipe.Validate().at(recipe.metric());
    if (best_factor == 0 || error < best_error) {
      best_error = error;
      best_factor = factor;
    }
  }
  network.Set(mean, rows * best_factor);
  log::Info("Rows of {:g} times the deviations miss validation faces least", best_factor);
  // The codes of the training faces minimise the same energy as those of unseen ones: a ridge regression.
  const torch::Tensor r = (rows * best_factor).to(torch::kFloat64);
  const double ridge = options.loss.code_weight / double(r.size(0)) * double(r.size(1)) / options.loss.data_weight;
  const torch::Tensor matrix = torch::matmul(r, r.t()) + ridge * torch::eye(r.size(0), r.options());
  const torch::Tensor moments = torch::matmul(r, (faces - mean).t().to(torch::kFloat64));
  recipe.decoder().codes().copy_(torch::linalg_solve(matrix, moments).t());
}

/// Fits and writes the model; of a run that is finished the summary alone.
TrainingSummary TrainLinear(DeformRecipe& recipe, const DeformTrainingOptions& options, const fs::path& directory) {
  if (ReadManifest(directory, "run").counts.contains("best_epoch")) {
    log::Info("{} is finished", directory.string());
    const std::vector<train::MetricsRecord> records = train::ReadMetrics(directory);
    DAUMIER_CHECK(!records.empty() && records.back().line.contains(recipe.metric()),
                  "{} does not hold the validation of the finished run. Restore it, or train again",
                  (directory / train::RunLog::kMetricsFile).string());
    return {.metric = recipe.metric(),
            .best = records.back().line[recipe.metric()].get<double>(),
            .seconds = records.back().seconds};
  }
  const Stopwatch stopwatch;
  FitLinear(recipe, options);
  const std::map<std::string, double> values = recipe.Validate();
  const double seconds = stopwatch.seconds();
  train::RunLog(directory, 0).Write(0, 0, "validation", values, {seconds, seconds});
  MakeDirectory(directory / "best");
  tensor::SaveModule(directory / kBestFile, recipe.module());
  return {.metric = recipe.metric(), .best = values.at(recipe.metric()), .seconds = seconds};
}

}  // namespace

TrainingSummary TrainDeform(const Json& config, const systems::RunPlace& place, FolderCache& databases,
                            const Task& task) {
  const fs::path& run_directory = place.directory;
  DeformTrainingOptions options = ParseTraining<DeformTrainingOptions>(config, "training config");
  if (options.trainer.precision == "auto") options.trainer.precision = "float32";  // There is no other one here.
  const torch::Device torch_device = tensor::TorchDevice(place.device);
  const auto& faces = databases.Open<faces::FaceDatabase>(options.data.faces);
  const auto& points = databases.Open<datasets::PointDatabase>(options.data.points);
  const datasets::Split split = datasets::MakeSplit(faces, options.split, options.seed);

  Manifest manifest = datasets::ManifestOfTraining(ToJson(options), options.seed, faces, split);
  manifest.details["system"] = kSystem;
  manifest.details["data"] = {{"faces", DataHash(options.data.faces)}, {"points", DataHash(options.data.points)}};

  const Json defaults = ToJson(DeformTrainingOptions());
  const bool is_linear = options.network.kind == "linear";  // Fitted in one step: it has no epochs.
  if (place.resume && !is_linear)
    train::LengthenFinishedRun(run_directory, manifest.config, manifest.details["data"], defaults);
  const bool begun =
      train::OpenRunFolder(run_directory, place.resume, manifest.config, manifest.details["data"], defaults);
  torch::manual_seed(options.seed);
  DeformRecipe recipe(options, faces, points, split, torch_device);
  if (begun) VerifyChecksums(run_directory, ReadManifest(run_directory, "run"));
  // Of all files the first one: it shows that the folder is a run's. Of a resumed run the data may have moved.
  WriteFileIfChanged(run_directory / "resolved.toml", ToToml(ToJson(options)));
  if (!begun) {
    manifest.checksums = faces::WriteFaceTemplate(run_directory, faces.face_template());
    WriteManifest(run_directory, manifest);
  }

  const int64_t num_parameters = recipe.decoder().network()->num_parameters();
  log::Info("Training {} parameters and a code of {} for each of {} faces", num_parameters, options.network.latent,
            recipe.num_samples());
  TrainingSummary summary = is_linear ? TrainLinear(recipe, options, run_directory)
                                      : train::Train(recipe, options.trainer, options.optimiser, options.seed,
                                                     run_directory, task, train::EarlierTrainings(run_directory));
  train::FinishRun(run_directory, summary, num_parameters);
  exporting::StoreGraph(DescribeDeformExport(run_directory));
  log::Info("Best validation: {:.3f} mm after epoch {} of {}; run folder {}", summary.best, summary.best_epoch,
            summary.epochs, run_directory.string());
  return summary;
}

}  // namespace daumier::deform
