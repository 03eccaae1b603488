#include "systems/deform/run_folder.h"

#include "core/error.h"
#include "core/run_manifest.h"
#include "faces/face_database.h"

namespace daumier::deform {

DeformRunFolder ReadDeformRunFolder(const std::filesystem::path& directory) {
  DeformRunFolder run;
  run.directory = directory;
  run.manifest = ReadFinishedRun(directory, kSystem);
  const std::filesystem::path config_file = ResolvedConfig(directory);
  run.config = ReadRunConfig(directory, run.manifest);
  run.face_template = faces::ReadFaceTemplate(directory);
  try {
    run.data_weight = run.config.at("loss").at("data_weight").get<double>();
    run.code_weight = run.config.at("loss").at("code_weight").get<double>();
    run.network_options = ParseOptions<DeformOptions>(run.config.at("network"), config_file.string());
  } catch (const Json::exception& error) {
    throw Error(fmt::format("{} is malformed: {}", config_file.string(), TextOf(error)));
  }
  return run;
}

}  // namespace daumier::deform
