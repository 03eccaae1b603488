#include "systems/prediction_folder.h"

#include "core/error.h"
#include "core/files.h"
#include "core/weights_folder.h"

#include <algorithm>
#include <utility>

namespace daumier::systems {
namespace {

namespace fs = std::filesystem;

/// Of a file, bytes: what file systems take, less the suffix of a file that is being written. Of it, how much is shown.
constexpr size_t kLongestName = 255 - 4, kMostShown = 40;

constexpr const char* kKind = "predictions";
constexpr const char* kManifestOfFolder = "manifest.json";
constexpr const char* kStaging = ".partial";  ///< Folder in the folder, where a result is before it is whole.

/// The files that the result of an input may have.
std::vector<std::string> FilesOfResult(const System& system, const std::string& name) {
  std::vector<std::string> files;
  for (const std::string& suffix : system.result_files) files.push_back(name + suffix);
  return files;
}

bool HasManifest(const fs::path& folder) {
  return fs::exists(folder / kManifestOfFolder);
}

/// The records of an earlier prediction. Those of another run or of other options than the manifest's name their own.
Json EarlierRecords(const Manifest& earlier, const Manifest& manifest) {
  const auto found = earlier.details.find("drawings");
  if (found == earlier.details.end() || !found->is_object()) return Json::object();
  Json records = *found;
  const Json run = earlier.details.value("run_data_hash", Json());
  for (auto& [name, record] : records.items()) {
    if (!record.is_object() || record.contains("options")) continue;
    if (earlier.config == manifest.config && run == manifest.details["run_data_hash"]) continue;
    record["options"] = earlier.config;
    record["run_data_hash"] = run;
  }
  return records;
}

/// A manifest without results.
Manifest ManifestOf(const System& system, const fs::path& run, const Json& options) {
  const bool is_shipped = IsWeightsFolder(run);
  const Manifest of_run = ReadManifest(run, is_shipped ? kWeightsKind : "run");
  Manifest manifest{.kind = kKind, .verb = "predict"};
  manifest.config = options;
  manifest.seed = of_run.seed;
  manifest.sources = of_run.sources;
  manifest.details = {{"system", system.name}, {"run_data_hash", DataHash(run)}, {"drawings", Json::object()}};
  if (is_shipped) manifest.details["weights"] = WeightsName(run);
  return manifest;
}

/// The files that a killed prediction had not finished.
std::set<std::string> UnfinishedIn(const Manifest& earlier, const fs::path& folder) {
  std::set<std::string> files;
  const auto listed = earlier.details.find(kUnfinishedFiles);
  if (listed == earlier.details.end() || !listed->is_array()) return files;
  for (const Json& file : *listed)
    if (file.is_string() && fs::is_regular_file(folder / file.get<std::string>())) files.insert(file);
  return files;
}

/// @throws UsageError if the folder holds predictions of another task.
void CheckSameTask(const System& system, const fs::path& folder) {
  if (!HasManifest(folder)) return;
  const std::string earlier = ReadManifest(folder, kKind).details.value("system", std::string(system.name));
  if (earlier != system.name)
    throw UsageError(fmt::format("{} holds predictions of the task '{}', and these are of '{}': name another folder",
                                 folder.string(), earlier, system.name));
}

/// @throws UsageError for names that no file can have, or that no line of an OBJ file, which names others, can hold.
void CheckName(const std::string& file) {
  if (file.size() > kLongestName)
    throw UsageError(
        fmt::format("the result {}... would have a name of {} bytes (expected at most {}). Rename the input",
                    file.substr(0, kMostShown), file.size(), kLongestName));
  const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7F; };
  if (std::any_of(file.begin(), file.end(), is_control)) {
    std::string shown = file;
    std::replace_if(shown.begin(), shown.end(), is_control, '?');
    throw UsageError(
        fmt::format("the result {} would have a line break or another control character (here ?) in its name. "
                    "Rename the input",
                    shown));
  }
}

}  // namespace

OutputKind PredictionOutput() {
  return {kKind};
}

void CheckPredictionFolder(const System& system, const fs::path& out_directory, const fs::path& run,
                           const PredictionInputs& inputs) {
  std::vector<fs::path> files{run};
  for (const PredictionInput& input : inputs.inputs) files.push_back(input.file);
  for (const PredictionFailure& failure : inputs.failures) files.push_back(failure.file);
  CheckOutputFolder(out_directory, PredictionOutput(), files);
  CheckSameTask(system, out_directory);
  std::vector<std::string> written;
  for (const PredictionInput& input : inputs.inputs)
    for (std::string& file : FilesOfResult(system, input.name)) written.push_back(std::move(file));
  for (const std::string& file : written) CheckName(file);
  CheckOwnFiles(out_directory, written);
}

PredictionFolder::PredictionFolder(const System& system, fs::path directory, const fs::path& run, const Json& options,
                                   const PredictionInputs& inputs, const Task& task)
    : system_(system),
      directory_(std::move(directory)),
      run_(run),
      inputs_(inputs),
      task_(task),
      was_absent_(!fs::exists(directory_)),
      manifest_(ManifestOf(system, run, options)) {
  CheckPredictionFolder(system_, directory_, run_, inputs_);
}

void PredictionFolder::Begin() {
  lock_.emplace(directory_, task_);
  has_earlier_ = HasManifest(directory_);
  if (!has_earlier_) return;
  CheckPredictionFolder(system_, directory_, run_, inputs_);  // Another program may have written into it since.
  const Manifest earlier = ReadManifest(directory_, kKind);
  for (const auto& [file, checksum] : earlier.checksums)
    if (fs::is_regular_file(directory_ / file) && Sha256OfFile(directory_ / file) == checksum)
      manifest_.checksums[file] = checksum;
  manifest_.details["drawings"] = EarlierRecords(earlier, manifest_);
  manifest_.details["failures"] = earlier.details.value("failures", Json::array());
  unfinished_ = UnfinishedIn(earlier, directory_);
}

void PredictionFolder::WriteManifestNow() {
  manifest_.counts = {{"drawings", manifest_.details["drawings"].size()}};
  manifest_.details.erase(kUnfinishedFiles);
  if (!unfinished_.empty()) manifest_.details[kUnfinishedFiles] = unfinished_;
  WriteManifest(directory_, manifest_);
}

std::vector<std::string> PredictionFolder::Staged(const Writer& write) {
  const fs::path staging = directory_ / kStaging;
  fs::remove_all(staging);  // Of a program that was killed.
  MakeDirectory(staging);
  return write(staging);
}

void PredictionFolder::Restore(const Manifest& before) {
  std::error_code ignored;
  fs::remove_all(directory_ / kStaging, ignored);
  manifest_ = before;
  if (num_results_ == 0 && !has_earlier_) {
    fs::remove(directory_ / kManifestOfFolder, ignored);
    if (was_absent_) fs::remove(directory_, ignored);  // If it is empty.
    return;
  }
  try {
    WriteManifestNow();
  } catch (const Error&) {  // The one that is there lists the result as unfinished.
  }
}

void PredictionFolder::Add(const PredictionInput& input, const Json& record,
                           const std::vector<PredictionFailure>& failures, const Writer& write) {
  if (!lock_) Begin();
  const Manifest before = manifest_;
  const std::set<std::string> unfinished_before = unfinished_;
  std::vector<std::string> files;
  try {
    // The manifest comes first: whenever the program is killed, the same command recognises its files.
    for (const std::string& file : FilesOfResult(system_, input.name))
      manifest_.checksums.erase(file), unfinished_.insert(file);
    manifest_.details["drawings"].erase(input.name);
    WriteManifestNow();
    files = Staged(write);
  } catch (...) {
    unfinished_ = unfinished_before;
    Restore(before);
    throw;
  }
  for (const std::string& file : files) {
    manifest_.checksums[file] = Sha256OfFile(directory_ / kStaging / file);
    fs::rename(directory_ / kStaging / file, directory_ / file);
  }
  fs::remove_all(directory_ / kStaging);
  unfinished_ = unfinished_before;
  for (const std::string& file : FilesOfResult(system_, input.name)) {
    unfinished_.erase(file);
    if (!manifest_.checksums.contains(file))
      fs::remove(directory_ / file);  // Of an earlier result that had more files.
  }
  Json& entry = manifest_.details["drawings"][input.name] = {{"file", input.file.filename().string()}};
  entry.update(record);
  ++num_results_;
  ListFailures(failures);
  WriteManifestNow();
}

void PredictionFolder::Finish(const std::vector<PredictionFailure>& failures) {
  if (num_results_ == 0) return;
  ListFailures(failures);
  WriteManifestNow();
}

void PredictionFolder::ListFailures(const std::vector<PredictionFailure>& failures) {
  Json& list = manifest_.details["failures"] = Json::array();
  for (const PredictionFailure& failure : failures) {
    std::string cause = failure.cause;  // Without paths: the file's name.
    if (const size_t at = cause.find(failure.file.string()); at != std::string::npos)
      cause.replace(at, failure.file.string().size(), failure.file.filename().string());
    list.push_back({{"file", failure.file.filename().string()}, {"cause", cause}});
  }
}

}  // namespace daumier::systems
