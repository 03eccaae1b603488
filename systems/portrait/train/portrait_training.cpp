#include "systems/portrait/train/portrait_training.h"

#include "core/config.h"
#include "core/error.h"
#include "core/files.h"
#include "core/log.h"
#include "datasets/read/portrait_database.h"
#include "datasets/read/run_data.h"
#include "systems/portrait/train/portrait_export.h"
#include "systems/portrait/train/portrait_prediction.h"
#include "systems/portrait/train/portrait_recipe.h"
#include "tensor/runtime.h"
#include "train/run_folder.h"
#include "train/trainer.h"

#include <torch/utils.h>

#include <algorithm>

namespace daumier::portrait {
namespace {

namespace fs = std::filesystem;

void CheckSameFaces(const faces::FaceDatabase& faces, const datasets::PortraitDatabase& portraits,
                    const PortraitDataOptions& data) {
  DAUMIER_CHECK(
      portraits.has_known_faces(),
      "{} holds pictures without known faces, as data.portraits are expected to have them. Name the folder in "
      "real, and portraits of {} in data.portraits",
      data.portraits, data.faces);
  const Json& details = portraits.manifest().details;
  DAUMIER_CHECK(!details.contains("faces_data_hash") || details.at("faces_data_hash") == DataHash(data.faces),
                "{} shows other faces than those of {} (data hash {}). Set data.faces to the folder it was made of",
                data.portraits, data.faces, DataHash(data.faces).substr(0, 12));
  DAUMIER_CHECK(faces.num_vertices() == portraits.face_template().num_vertices(),
                "{} has faces of {} vertices, {} of {}", data.portraits, portraits.face_template().num_vertices(),
                data.faces, faces.num_vertices());
}

}  // namespace

TrainingSummary TrainPortrait(const Json& config, const systems::RunPlace& place, FolderCache& databases,
                              const Task& task) {
  const fs::path& run_directory = place.directory;
  auto options = ParseTraining<PortraitTrainingOptions>(config, "training config");
  if (options.trainer.precision == "auto") options.trainer.precision = "float32";
  const torch::Device device = tensor::TorchDevice(place.device);
  const auto& faces = databases.Open<faces::FaceDatabase>(options.data.faces);
  const auto& portraits = databases.Open<datasets::PortraitDatabase>(options.data.portraits);
  CheckSameFaces(faces, portraits, options.data);
  const datasets::Split split = datasets::MakeSplit(faces, options.split, options.seed);
  PortraitSets sets{ImagesOfPersons(portraits, PersonsOf(faces, split.train), options.pictures.leave_out),
                    ImagesOfPersons(portraits, PersonsOf(faces, split.validation))};
  if (!options.real.empty()) sets.real = &databases.Open<datasets::PortraitDatabase>(options.real);

  Manifest manifest = datasets::ManifestOfTraining(train::WithoutPaths(ToJson(options)), options.seed, faces, split);
  manifest.details["system"] = kPortraitSystem;
  manifest.details["data"] = {{"faces", DataHash(options.data.faces)}, {"portraits", DataHash(options.data.portraits)}};
  if (sets.real != nullptr) {
    manifest.details["data"]["real"] = DataHash(options.real);
    for (const Json& source : sets.real->manifest().sources)
      if (std::ranges::count(manifest.sources, source) == 0) manifest.sources.push_back(source);
  }

  PortraitTrainingOptions of_defaults;
  const Json defaults = train::WithoutPaths(ToJson(of_defaults));
  if (place.resume) train::LengthenFinishedRun(run_directory, manifest.config, manifest.details["data"], defaults);
  const bool begun =
      train::OpenRunFolder(run_directory, place.resume, manifest.config, manifest.details["data"], defaults);
  if (begun) VerifyChecksums(run_directory, ReadManifest(run_directory, "run"));
  const faces::MorphableModel model =
      begun ? faces::ReadMorphableModel(run_directory) : ModelOfTraining(faces, PersonsOf(faces, split.train), options);
  DAUMIER_CHECK(model.expression_names == portraits.expression_names(),
                "{} holds {} expression weights of other shapes than the source '{}' has ({})", options.data.portraits,
                portraits.expression_names().size(), options.source.name, model.expression_names.size());
  torch::manual_seed(options.seed);
  PortraitRecipe recipe(options, model, portraits, sets, device);
  WriteFileIfChanged(run_directory / "resolved.toml", ToToml(ToJson(options)));
  if (!begun) {
    manifest.counts["training_portraits"] = recipe.num_samples();
    manifest.checksums = faces::WriteMorphableFiles(run_directory, model);
    WriteManifest(run_directory, manifest);
  }
  const int64_t num_parameters = recipe.network()->num_parameters();
  log::Info("Training {} parameters on {} portraits; {} identity modes, {} expressions", num_parameters,
            recipe.num_samples(), model.identity.cols(), model.expression.cols());
  const TrainingSummary summary = train::Train(recipe, options.trainer, options.optimiser, options.seed, run_directory,
                                               task, train::EarlierTrainings(run_directory));
  train::FinishRun(run_directory, summary, num_parameters);
  exporting::StoreGraph(DescribePortraitExport(run_directory));
  log::Info("Best validation: {:.3f} mm after epoch {} of {}; run folder {}", summary.best, summary.best_epoch,
            summary.epochs, run_directory.string());
  return summary;
}

}  // namespace daumier::portrait
