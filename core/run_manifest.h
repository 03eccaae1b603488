#pragma once
#include <filesystem>

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

}  // namespace daumier
