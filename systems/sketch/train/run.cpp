#include "systems/sketch/train/run.h"

#include "core/config.h"
#include "core/error.h"
#include "core/run_manifest.h"
#include "faces/face_database.h"
#include "render/camera_json.h"
#include "tensor/module_state.h"

namespace daumier::sketch {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBilinear = "bilinear.safetensors";
constexpr const char* kCurves = "curves.safetensors";
constexpr const char* kBasis = "basis.safetensors";

/// @throws Error if the manifest is not that of a run.
void ReadSketchFrame(const Manifest& manifest, SketchRun& run) {
  try {
    const Json& sketches = manifest.details.at("sketches");
    run.camera = render::CameraFromJson(sketches.at("camera"));
    run.feature_curves = sketches.at("feature_curves").get<std::vector<std::string>>();
  } catch (const Json::exception& error) {
    throw Error(fmt::format("{}: the manifest does not tell how the sketches were seen ({}): train again",
                            run.directory.string(), error.what()));
  }
}

}  // namespace

std::map<std::string, std::string> WriteFittedModels(const fs::path& directory, const FittedModels& models) {
  std::map<std::string, std::string> checksums;
  checksums[kBilinear] = faces::WriteBilinearModel(directory / kBilinear, models.bilinear);
  checksums[kCurves] = faces::WriteBilinearModel(directory / kCurves, models.curves);
  if (models.basis.size() > 0) checksums[kBasis] = faces::WriteFaceBasis(directory / kBasis, models.basis);
  return checksums;
}

FittedModels ReadFittedModels(const fs::path& directory) {
  FittedModels models{
      faces::ReadBilinearModel(directory / kBilinear), faces::ReadBilinearModel(directory / kCurves), {}};
  if (fs::exists(directory / kBasis)) models.basis = faces::ReadFaceBasis(directory / kBasis);
  return models;
}

SketchRun LoadSketchRun(const fs::path& directory) {
  SketchRun run;
  run.directory = directory;
  DAUMIER_CHECK(fs::exists(directory / "manifest.json"),
                "{} is not a run folder (manifest.json is missing): make one with `daumier train CONFIG --out {}`",
                directory.string(), directory.string());
  run.manifest = ReadManifest(directory, "run");
  const auto config_file = ResolvedConfig(directory), weights_file = BestWeights(directory);
  DAUMIER_CHECK(fs::exists(weights_file),
                "{} has no best weights yet ({} is missing): go on training it with `daumier train --resume --out {}`",
                directory.string(), weights_file.string(), directory.string());
  VerifyChecksums(directory, run.manifest);
  run.config = LoadConfig(config_file);
  DAUMIER_CHECK(run.config.contains("network"), "{} has no table 'network': it is not the config of a sketch run",
                config_file.string());
  run.face_template = faces::ReadFaceTemplate(directory);
  run.models = ReadFittedModels(directory);
  const int num_coordinates = run.models.bilinear.num_coordinates();
  DAUMIER_CHECK(num_coordinates == 3 * run.face_template.num_vertices(),
                "{}: the bilinear model has {} coordinates, but the template {} vertices", directory.string(),
                num_coordinates, run.face_template.num_vertices());
  ReadSketchFrame(run.manifest, run);
  run.network =
      SketchNetwork(ParseOptions<SketchNetworkOptions>(run.config["network"], config_file.string()), run.models);
  tensor::LoadModule(weights_file, *run.network);
  run.network->eval();
  return run;
}

}  // namespace daumier::sketch
