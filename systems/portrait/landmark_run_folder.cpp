#include "systems/portrait/landmark_run_folder.h"

#include "core/error.h"
#include "core/run_manifest.h"

namespace daumier::portrait {

LandmarkRunFolder ReadLandmarkRunFolder(const std::filesystem::path& directory) {
  LandmarkRunFolder run;
  run.directory = directory;
  run.manifest = ReadFinishedRun(directory, kLandmarkSystem);
  run.config = ReadRunConfig(directory, run.manifest);
  const std::string file = ResolvedConfig(directory).string();
  DAUMIER_CHECK(run.config.contains("network"), "{} has no table 'network': it is not the config of a landmark run",
                file);
  run.network_options = ParseOptions<LandmarkNetworkOptions>(run.config["network"], file);
  return run;
}

}  // namespace daumier::portrait
