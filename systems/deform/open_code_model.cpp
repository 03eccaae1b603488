#include "systems/deform/open_code_model.h"

#include "core/error.h"
#include "core/evenly_spaced.h"
#include "core/run_manifest.h"
#include "core/statistics.h"
#include "core/training.h"
#include "core/weights_folder.h"
#include "datasets/read/splits.h"
#include "faces/face_gaussian.h"
#include "faces/face_model_file.h"
#include "systems/deform/linear_code_model.h"
#include "systems/deform/network_code_model.h"
#include "systems/deform/options.h"
#include "systems/deform/run_folder.h"
#include "systems/shipped_weights.h"

#include <numeric>
#include <utility>
#include <vector>

namespace daumier::deform {
namespace {

namespace fs = std::filesystem;

OpenedModel OpenRun(const fs::path& folder) {
  const DeformRunFolder run = ReadDeformRunFolder(folder);
  OpenedModel opened{
      .model = nullptr, .name = {}, .kind = run.network_options.kind, .sources = run.manifest.sources, .data_hash = {}};
  const fs::path weights = BestWeights(folder);
  if (opened.kind == "linear") {
    opened.model = std::make_unique<LinearCodeModel>(LinearFacesOfRun(run.face_template, run.network_options, weights));
  } else {
    opened.model = std::make_unique<NetworkCodeModel>(run.face_template, run.network_options, weights);
  }
  const fs::path faces = run.config.value(Json::json_pointer("/data/faces"), std::string());
  const Json::json_pointer hash("/data/faces");
  if (faces.empty() || !fs::exists(faces / "manifest.json") || !run.manifest.details.contains(hash) ||
      run.manifest.details.at(hash) != DataHash(faces))
    return opened;
  opened.faces = faces;
  const auto options = ParseTraining<DeformTrainingOptions>(run.config, ResolvedConfig(folder).string());
  const faces::FaceDatabase database(faces, Checksums::kSkip);
  opened.training_faces = datasets::MakeSplit(database, options.split, options.seed).train;
  opened.training_codes = TrainingCodes(run.network_options, weights);
  DAUMIER_CHECK(opened.training_codes.rows() == std::ssize(opened.training_faces),
                "{}: {} codes of {} training faces. Train again", weights.string(), opened.training_codes.rows(),
                opened.training_faces.size());
  return opened;
}

OpenedModel OpenFaces(const fs::path& folder) {
  const faces::FaceDatabase database(folder);
  std::vector<int> all(size_t(database.num_faces()));
  std::iota(all.begin(), all.end(), 0);
  const std::vector<int> chosen = EvenlySpaced(all, kMostFaces);
  DAUMIER_CHECK(chosen.size() >= 8, "{}: {} faces are too few for a model (expected 8 or more)", folder.string(),
                chosen.size());
  const int most = int(chosen.size()) - 1;
  const auto face = [&](int i) { return database.vertices(chosen[size_t(i)]); };
  const faces::FaceGaussian gaussian = faces::FitFaceGaussian(
      int(chosen.size()), 3 * database.num_vertices(), face, database.face_template().annotation.mirror,
      {.num_symmetric = std::min(kNumSymmetric, most), .num_asymmetric = std::min(kNumAsymmetric, most)});
  std::vector<double> lengths;
  for (int i = 0; i < std::ssize(chosen); ++i)
    lengths.push_back(faces::CoefficientsOf(gaussian, face(i)).cast<double>().norm());
  return {.model = std::make_unique<LinearCodeModel>(
              LinearFacesOf(database.face_template(), gaussian, Percentile(lengths, 99))),
          .name = {},
          .kind = "faces",
          .sources = database.manifest().sources,
          .data_hash = {},
          .faces = folder};
}

OpenedModel OpenFaceModel(const fs::path& folder) {
  const Manifest manifest = ReadManifest(folder, kWeightsKind);
  LinearFaces caricatures = LinearCaricatures(faces::ReadFaceModelWeights(folder));
  std::vector<int> expression = caricatures.expression;
  return {.model = std::make_unique<LinearCodeModel>(std::move(caricatures)),
          .name = {},
          .kind = "face model",
          .sources = manifest.sources,
          .data_hash = {},
          .expression = std::move(expression)};
}

}  // namespace

OpenedModel OpenCodeModel(const fs::path& folder) {
  constexpr const char* kExpected =
      "expected a finished run of the task `deform`, a folder of faces, or weights of a face model";
  if (!fs::exists(folder / "manifest.json"))
    throw UsageError(fmt::format("{}: there is no model here ({})", folder.string(), kExpected));
  const Manifest manifest = ReadManifest(folder, "");
  OpenedModel opened;
  if (manifest.kind == "run") {
    opened = OpenRun(folder);
  } else if (manifest.kind == "faces") {
    opened = OpenFaces(folder);
  } else if (manifest.kind == kWeightsKind && SystemOf(manifest) == kFaceModelSystem) {
    opened = OpenFaceModel(folder);
  } else {
    throw UsageError(fmt::format("{}: this is a folder of kind '{}' ({})", folder.string(), manifest.kind, kExpected));
  }
  opened.name = fs::weakly_canonical(folder).filename().string();
  opened.data_hash = DataHash(folder);
  return opened;
}

fs::path ShippedModel() {
  for (const systems::ShippedWeights& weights : systems::ListWeights(systems::WeightsPlaces()))
    if (weights.system == kFaceModelSystem) return weights.directory;
  throw UsageError(
      "there is no shipped face model (weights/face-ict). Restore it, or name a run of the task `deform` or a folder "
      "of faces first");
}

}  // namespace daumier::deform
