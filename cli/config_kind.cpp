#include "cli/config_kind.h"

#include "benchmark/definition.h"
#include "core/config.h"
#include "core/options.h"
#include "datasets/build/faces.h"
#include "datasets/build/points.h"
#include "datasets/build/portraits.h"
#include "datasets/build/registered_faces.h"
#include "datasets/build/sketches.h"

#include <algorithm>

namespace daumier::cli {
namespace {

template <class Options>
bool Accepts(const Json& config) {
  try {
    ParseOptions<Options>(config);
    return true;
  } catch (const UsageError&) {
    return false;
  }
}

}  // namespace

std::string CommandOfConfig(const Json& config) {
  if (config.empty()) return "";
  const auto has = [&](const char* key) { return config.contains(key); };
  if (has("rows")) return "ablate";
  // Of every training (core/training.h).
  if (has("system") || has("product") || has("network") || has("optimiser")) return "train";
  std::vector<std::string> commands;
  if (Accepts<datasets::FacesOptions>(config)) commands.push_back("dataset faces");
  if (Accepts<datasets::SketchesOptions>(config)) commands.push_back("dataset sketches");
  if (Accepts<datasets::PointsOptions>(config)) commands.push_back("dataset points");
  if (Accepts<datasets::PortraitsOptions>(config)) commands.push_back("dataset portraits");
  if (Accepts<datasets::RegisterOptions>(config)) commands.push_back("register");
  if (Accepts<benchmark::BenchmarkOptions>(config)) commands.push_back("benchmark make");
  return commands.size() == 1 ? commands.front() : "";
}

void FailOnConfig(const UsageError& error, const std::filesystem::path& file, const std::string& command) {
  std::string other;
  try {
    if (!file.empty()) other = CommandOfConfig(LoadConfig(file));
  } catch (const UsageError&) {  // The file cannot be read: `error` says so.
  }
  if (other.empty() || other == command) throw error;
  const bool is_first = other == "train" || other == "ablate";  // The config is the first argument.
  throw UsageError(fmt::format("{} is a config of `daumier {}`, not of `daumier {}`. Try daumier {} {}{} --out FOLDER",
                               file.string(), other, command, other, is_first ? "" : "--config ", file.string()));
}

}  // namespace daumier::cli
