#include "train/run_folder.h"

#include "core/config_differences.h"
#include "core/error.h"
#include "core/files.h"
#include "core/log.h"
#include "core/output_place.h"
#include "train/precision.h"

#include <optional>

namespace daumier::train {
namespace {

/// What differs between a run, by its manifest, and what is to be trained now.
std::vector<std::string> RunDifferences(const Manifest& run, const Json& config, const Json& data,
                                        const Json& defaults) {
  Json there = run.config, now = config;
  there.erase("product");  // Of earlier versions, in the place of `system`.
  if (now.contains("precision"))
    now["precision"] = PrecisionForRun(now["precision"], there.value("precision", std::string("float32")));
  std::vector<std::string> lines = ConfigDifferences(there, now, defaults);
  for (const std::string& line : ConfigDifferences({{"data", run.details.value("data", Json())}}, {{"data", data}}))
    lines.push_back(line);
  return lines;
}

bool IsFinished(const Manifest& run) {
  return run.counts.contains("best_epoch");
}

/// Absent where the number is no count of epochs.
std::optional<int64_t> EpochsOf(const Json& config) {
  const auto found = config.find("epochs");
  if (found == config.end() || !found->is_number_integer()) return std::nullopt;
  return found->get<int64_t>();
}

/// What to do about other epochs; empty if they are the same.
std::string EpochsRepair(const std::filesystem::path& directory, const Manifest& run, const Json& config) {
  const std::optional<int64_t> there = EpochsOf(run.config), now = EpochsOf(config);
  if (!there || !now || *there == *now) return "";
  if (*now < *there)
    return fmt::format("\nResume it with epochs={}, or name another folder for a shorter training", *there);
  const std::string longer = ResumeCommand(directory, fmt::format("epochs={}", *now));
  if (IsFinished(run)) return fmt::format("\nTo train the finished run longer: {}", longer);
  return fmt::format("\nFinish it first: {}\nThen train it longer: {}", ResumeCommand(directory), longer);
}

}  // namespace

void LengthenFinishedRun(const std::filesystem::path& directory, const Json& config, const Json& data,
                         const Json& defaults) {
  if (!std::filesystem::exists(directory / "manifest.json")) return;
  Manifest run = ReadManifest(directory, "run");
  const std::optional<int64_t> there = EpochsOf(run.config), now = EpochsOf(config);
  if (!IsFinished(run) || !there || !now || *now <= *there) return;
  Json of_same_length = config;
  of_same_length["epochs"] = run.config["epochs"];
  if (!RunDifferences(run, of_same_length, data, defaults).empty()) return;
  VerifyChecksums(directory, run);
  const std::optional<int64_t> finished = EpochsOf(run.counts);
  DAUMIER_CHECK(finished && *finished > 0 && *finished < *now,
                "{}: the manifest does not hold how many epochs the run was trained (expected 1 to {}). Train again",
                directory.string(), *there);
  Json& earlier = run.details["earlier_trainings"];
  if (!earlier.is_array()) earlier = Json::array();
  earlier.push_back({{"planned_epochs", *there}, {"epochs", *finished}});
  run.config["epochs"] = config["epochs"];
  for (const char* key : {"steps", "epochs", "best_epoch"}) run.counts.erase(key);
  for (const char* file : {kBestFile, kBestGraph}) run.checksums.erase(file);
  WriteManifest(directory, run);
  std::filesystem::remove(directory / kBestGraph);  // Of weights that the longer training may replace.
  log::Info("Training {} from epoch {} on to epoch {}", directory.string(), *finished, *now);
}

std::vector<EarlierTraining> EarlierTrainings(const std::filesystem::path& directory) {
  const Manifest run = ReadManifest(directory, "run");
  std::vector<EarlierTraining> trainings;
  try {
    for (const Json& one : run.details.value("earlier_trainings", Json::array()))
      trainings.push_back({one.at("planned_epochs").get<int64_t>(), one.at("epochs").get<int64_t>()});
  } catch (const Json::exception& error) {
    throw Error(fmt::format("{}: details.earlier_trainings of the manifest is malformed: {}. Train again",
                            directory.string(), TextOf(error)));
  }
  return trainings;
}

Json WithoutPaths(Json config) {
  for (const char* key : {"data", "real"}) config.erase(key);
  if (const auto source = config.find("source"); source != config.end() && source->is_object())
    for (const char* key : {"path", "annotation", "template_mesh"}) source->erase(key);
  return config;
}

bool OpenRunFolder(const std::filesystem::path& directory, bool resume, const Json& config, const Json& data,
                   const Json& defaults) {
  namespace fs = std::filesystem;
  CheckOutputFolder(directory, RunOutput());
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
  const std::vector<std::string> lines = RunDifferences(manifest, config, data, defaults);
  if (!lines.empty())
    throw UsageError(fmt::format("{} cannot be resumed, for its run is another one:\n  {}{}", directory.string(),
                                 fmt::join(lines, "\n  "),
                                 lines.size() == 1 ? EpochsRepair(directory, manifest, config) : ""));
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
