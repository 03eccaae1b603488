#include "systems/sketch/run_folder.h"

#include "core/error.h"
#include "core/run_manifest.h"
#include "faces/face_database.h"
#include "render/camera_json.h"

namespace daumier::sketch {
namespace {

void ReadSketchFrame(SketchRunFolder& run) {
  try {
    const Json& sketches = run.manifest.details.at("sketches");
    run.camera = render::CameraFromJson(sketches.at("camera"));
    run.feature_curves = sketches.at("feature_curves").get<std::vector<std::string>>();
  } catch (const Json::exception& error) {
    throw Error(fmt::format("{}: the manifest does not hold the frame of the sketches ({}). Train again",
                            run.directory.string(), TextOf(error)));
  }
}

}  // namespace

SketchRunFolder ReadSketchRunFolder(const std::filesystem::path& directory) {
  SketchRunFolder run;
  run.directory = directory;
  run.manifest = ReadFinishedRun(directory, kSystem);
  const std::filesystem::path config_file = ResolvedConfig(directory);
  run.config = ReadRunConfig(directory, run.manifest);
  DAUMIER_CHECK(run.config.contains("network"), "{} has no table 'network': it is not the config of a sketch run",
                config_file.string());
  run.network_options = ParseOptions<SketchNetworkOptions>(run.config["network"], config_file.string());
  run.face_template = faces::ReadFaceTemplate(directory);
  run.models = ReadFittedModels(directory);
  const int num_coordinates = run.models.bilinear.num_coordinates();
  DAUMIER_CHECK(num_coordinates == 3 * run.face_template.num_vertices(),
                "{}: the bilinear model has {} coordinates, but the template {} vertices", directory.string(),
                num_coordinates, run.face_template.num_vertices());
  ReadSketchFrame(run);
  return run;
}

}  // namespace daumier::sketch
