#include "train/run_folder.h"

#include "core/error.h"
#include "core/files.h"
#include "train/precision.h"

#include <set>

namespace daumier::train {
namespace {

void AppendDifferences(const std::string& prefix, const Json& there, const Json& now, const Json& defaults,
                       std::vector<std::string>& lines) {
  if (!there.is_object() || !now.is_object()) {
    if (there != now) lines.push_back(fmt::format("{} is {} there and {} now", prefix, there.dump(), now.dump()));
    return;
  }
  std::set<std::string> keys;
  for (const Json* side : {&there, &now})
    for (const auto& [key, value] : side->items()) keys.insert(key);
  for (const std::string& key : keys) {
    const std::string dotted = prefix.empty() ? key : fmt::format("{}.{}", prefix, key);
    const Json default_value = defaults.is_object() && defaults.contains(key) ? defaults.at(key) : Json();
    if (!now.contains(key)) {
      lines.push_back(fmt::format("{} is {} there and missing now", dotted, there[key].dump()));
    } else if (!there.contains(key) && default_value.is_null()) {
      lines.push_back(fmt::format("{} is missing there and {} now", dotted, now[key].dump()));
    } else {
      AppendDifferences(dotted, there.contains(key) ? there[key] : default_value, now[key], default_value, lines);
    }
  }
}

}  // namespace

std::vector<std::string> ConfigDifferences(const Json& there, const Json& now, const Json& defaults) {
  std::vector<std::string> lines;
  AppendDifferences("", there, now, defaults, lines);
  return lines;
}

bool OpenRunFolder(const std::filesystem::path& directory, bool resume, const Json& config, const Json& data,
                   const Json& defaults) {
  namespace fs = std::filesystem;
  const bool begun = fs::exists(directory / "resolved.toml") || fs::exists(directory / "manifest.json");
  if (begun && !resume)
    throw UsageError(fmt::format("{} already holds a run: resume it with --resume, or name another folder by --out",
                                 directory.string()));
  if (!begun && resume)
    throw UsageError(
        fmt::format("{} holds no run that could be resumed: leave out --resume to start one", directory.string()));
  MakeDirectory(directory);
  if (!fs::exists(directory / "manifest.json")) return false;  // Stopped while it was being set up.

  const Manifest manifest = ReadManifest(directory, "run");
  Json there = manifest.config, now = config;
  there.erase("product");  // Of earlier versions, in the place of `system`.
  if (now.contains("precision"))
    now["precision"] = PrecisionForRun(now["precision"], there.value("precision", std::string("float32")));
  std::vector<std::string> lines = ConfigDifferences(there, now, defaults);
  for (const std::string& line :
       ConfigDifferences({{"data", manifest.details.value("data", Json())}}, {{"data", data}}))
    lines.push_back(line);
  if (!lines.empty())
    throw UsageError(fmt::format("{} cannot be resumed, for its run is another one:\n  {}", directory.string(),
                                 fmt::join(lines, "\n  ")));
  return true;
}

void FinishRun(const std::filesystem::path& directory, const TrainingSummary& summary, int64_t num_parameters) {
  Manifest manifest = ReadManifest(directory, "run");
  manifest.counts["parameters"] = num_parameters;
  manifest.counts["steps"] = summary.steps;
  manifest.counts["epochs"] = summary.epochs;
  manifest.counts["best_epoch"] = summary.best_epoch;
  manifest.checksums[kBestFile] = Sha256OfFile(directory / kBestFile);
  WriteManifest(directory, manifest);
}

}  // namespace daumier::train
