#include "systems/portrait/portrait_run_folder.h"

#include "core/run_manifest.h"

namespace daumier::portrait {

PortraitRunFolder ReadPortraitRunFolder(const std::filesystem::path& directory) {
  PortraitRunFolder run;
  run.directory = directory;
  run.manifest = ReadFinishedRun(directory, kPortraitSystem);
  run.config = ReadRunConfig(directory, run.manifest);
  run.options = ParseOptions<PortraitTrainingOptions>(run.config, ResolvedConfig(directory).string());
  run.model = faces::ReadMorphableModel(directory);
  return run;
}

}  // namespace daumier::portrait
