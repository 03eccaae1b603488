#pragma once
#include "core/manifest.h"
#include "core/output_place.h"

#include <filesystem>
#include <string>

/// Paths in a run folder, the one definition of its layout (docs/formats.md). The manifest names files relative to the
/// folder.
namespace daumier {

/// The weights of the least validation error, relative to the run folder: the key of their checksum in the manifest.
inline constexpr const char* kBestFile = "best/model.safetensors";

inline std::filesystem::path BestWeights(const std::filesystem::path& run) {
  return run / kBestFile;
}

/// The training's options with every default filled in.
inline std::filesystem::path ResolvedConfig(const std::filesystem::path& run) {
  return run / "resolved.toml";
}

/// One JSON object a line.
inline std::filesystem::path MetricsLog(const std::filesystem::path& run) {
  return run / "metrics.jsonl";
}

/// A folder: all that a training needs to resume.
inline std::filesystem::path LatestCheckpoint(const std::filesystem::path& run) {
  return run / "checkpoints" / "latest";
}

/// Where `daumier eval` writes unless --out is given.
inline std::filesystem::path ReportDirectory(const std::filesystem::path& run) {
  return run / "report";
}

inline std::filesystem::path ReportMetrics(const std::filesystem::path& run) {
  return ReportDirectory(run) / "metrics.json";
}

/// The exported graph of a finished run, next to the file of its weights.
inline constexpr const char* kBestGraph = "best/model.onnx";

/// A run folder, finished or stopped, as an output.
inline OutputKind RunOutput() {
  return {"run", {"resolved.toml"}};
}

/// The task that a run was trained for: details.system; of runs of earlier versions details.product, or "sketch".
std::string SystemOf(const Manifest& run);

/// The command that resumes the training of a run folder, for messages: its config is resolved.toml. `extra` follows.
std::string ResumeCommand(const std::filesystem::path& directory, const std::string& extra = "");

/// For a run folder that is resumed: each folder of config.data is there. @throws UsageError naming the folder and the
/// option that names another.
void CheckDataIsThere(const Json& config, const std::filesystem::path& directory);

/// resolved.toml of a run. @throws UsageError as LoadConfig; Error if it names another task than the manifest, or if an
/// option that the manifest holds, too, has another value or is missing: all but the folders of data.
Json ReadRunConfig(const std::filesystem::path& directory, const Manifest& run);

/// The manifest of the run folder `directory`, which has best weights.
/// @throws Error naming file, cause and repair if `directory` is no run folder, is a run of another task than `system`
/// (unless that is empty), has no best weights yet, or if a file differs from its checksum.
Manifest ReadFinishedRun(const std::filesystem::path& directory, const std::string& system = "");

}  // namespace daumier
