#include "systems/portrait/landmark_run_folder.h"

#include "core/error.h"
#include "core/run_manifest.h"
#include "core/weights_folder.h"

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

LandmarkNetworkOptions ReadLandmarkNetworkOptions(const std::filesystem::path& run_or_weights) {
  if (!IsWeightsFolder(run_or_weights)) return ReadLandmarkRunFolder(run_or_weights).network_options;
  const Manifest manifest = ReadWeights(run_or_weights, kLandmarkSystem, {kWeightsNetwork});
  return ParseOptions<LandmarkNetworkOptions>(manifest.details.value("network", Json::object()),
                                              (run_or_weights / "manifest.json").string());
}

}  // namespace daumier::portrait
