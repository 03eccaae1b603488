#include "ablation/database_task.h"

#include "core/files.h"
#include "core/manifest.h"
#include "train/run_folder.h"

#include <algorithm>
#include <chrono>

namespace daumier::ablation {

namespace fs = std::filesystem;

bool DatabaseAblation::Finished(const fs::path& run, const Json& config) const {
  Json without_paths = config, hashes;
  without_paths.erase("data");
  for (const auto& [database, folder] : config.at("data").items())
    hashes[database] = DataHash(folder.get<std::string>());
  const Json defaults = ResolvedConfig({{"data", config.at("data")}}, 0, "person", run.string());
  train::OpenRunFolder(run, /*resume=*/true, without_paths, hashes, defaults);
  return ReadManifest(run, "run").counts.contains("best_epoch");
}

void DatabaseAblation::Train(const Json& config, const fs::path& run) const {
  const bool begun = fs::exists(run / "resolved.toml") || fs::exists(run / "manifest.json");
  TrainRun(config, run, begun, device_);
}

bool DatabaseAblation::HasLine(const Json& metrics, const std::string& line) const {
  const Json& table = metrics.at("table");
  return std::any_of(table.begin(), table.end(), [&](const Json& entry) { return entry.at("name") == line; });
}

std::string DatabaseAblation::TestedOn(const Json& metrics) const {
  return fmt::format("{} faces of {}, faces {}, data {}", metrics.at("num_faces").dump(), metrics.at("split").dump(),
                     Sha256(metrics.at("faces").dump()).substr(0, 12), metrics.at("data_hash").dump());
}

double DatabaseAblation::MedianMs(const std::function<void()>& answer) {
  constexpr int kCalls = 51;
  std::vector<double> ms;
  for (int call = 0; call < kCalls; ++call) {
    const auto start = std::chrono::steady_clock::now();
    answer();
    ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  return eval::Percentile(ms, 50);
}

}  // namespace daumier::ablation
