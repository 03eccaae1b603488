#include "core/run_manifest.h"

#include "core/error.h"

namespace daumier {

namespace fs = std::filesystem;

std::string SystemOf(const Manifest& run) {
  if (run.details.contains("system")) return run.details.at("system").get<std::string>();
  return run.details.value("product", "sketch");
}

Manifest ReadFinishedRun(const fs::path& directory, const std::string& system) {
  DAUMIER_CHECK(fs::exists(directory / "manifest.json"),
                "{} is not a run folder (manifest.json is missing): make one with `daumier train CONFIG --out {}`",
                directory.string(), directory.string());
  Manifest manifest = ReadManifest(directory, "run");
  const std::string found = SystemOf(manifest);
  DAUMIER_CHECK(system.empty() || found == system,
                "{}: this is a run of the task '{}' (expected a run of '{}'). Name a run that was trained for '{}'",
                directory.string(), found, system, system);
  DAUMIER_CHECK(fs::exists(BestWeights(directory)),
                "{} has no best weights yet ({} is missing): resume it with `daumier train CONFIG --resume --out {}`",
                directory.string(), BestWeights(directory).string(), directory.string());
  VerifyChecksums(directory, manifest);
  return manifest;
}

}  // namespace daumier
