#include "train/checkpoint.h"

#include "core/error.h"
#include "core/files.h"

namespace daumier::train {
namespace {

namespace fs = std::filesystem;

constexpr int kFormatVersion = 1;
constexpr const char* kStateFile = "state.json";
constexpr const char* kTimeFile = "time.json";

fs::path SiblingPath(const fs::path& directory, const char* suffix) {
  return directory.string() + suffix;
}

std::optional<double> ReadSeconds(const fs::path& file) {
  if (!fs::exists(file)) return std::nullopt;
  const Json time = TryParseJson(ReadFile(file)).value_or(Json());
  DAUMIER_CHECK(time.is_object() && time.contains("seconds") && time["seconds"].is_number(),
                "{} is damaged: it has no seconds. Delete it to resume without the time until now", file.string());
  return time["seconds"].get<double>();
}

tensor::NamedTensors ReadChecked(const fs::path& file, const Json& checksums) {
  const std::string name = file.filename().string();
  DAUMIER_CHECK(checksums.contains(name) && checksums[name] == Sha256OfFile(file),
                "{} is damaged: its content is not what its checkpoint was written with", file.string());
  return tensor::LoadTensors(file);
}

}  // namespace

void WriteCheckpoint(const fs::path& directory, const Checkpoint& checkpoint) {
  const fs::path fresh = SiblingPath(directory, ".new"), old = SiblingPath(directory, ".old");
  fs::remove_all(fresh);
  MakeDirectory(fresh);
  Json checksums = Json::object();
  checksums["model.safetensors"] = tensor::SaveTensors(fresh / "model.safetensors", checkpoint.model);
  checksums["optimiser.safetensors"] = tensor::SaveTensors(fresh / "optimiser.safetensors", checkpoint.optimiser);
  checksums["random.safetensors"] = tensor::SaveTensors(fresh / "random.safetensors", checkpoint.random);
  if (checkpoint.seconds) WriteFileAtomically(fresh / kTimeFile, Json{{"seconds", *checkpoint.seconds}}.dump() + "\n");
  const Json head = {{"format_version", kFormatVersion}, {"state", checkpoint.state}, {"checksums", checksums}};
  WriteFileAtomically(fresh / kStateFile, head.dump(2) + "\n");

  if (fs::exists(directory)) {
    fs::remove_all(old);
    fs::rename(directory, old);
  }
  fs::rename(fresh, directory);
  fs::remove_all(old);
}

std::optional<Checkpoint> ReadCheckpoint(const fs::path& directory) {
  // Between the two renames of WriteCheckpoint only the old folder exists.
  const fs::path source = fs::exists(directory) ? directory : SiblingPath(directory, ".old");
  if (!fs::exists(source)) return std::nullopt;
  const Json head = TryParseJson(ReadFile(source / kStateFile)).value_or(Json());
  DAUMIER_CHECK(
      head.is_object() && head.contains("format_version") && head.contains("state") && head.contains("checksums"),
      "{} is damaged: it is no checkpoint state", (source / kStateFile).string());
  DAUMIER_CHECK(head["format_version"] == kFormatVersion, "{} has the format version {}, this program reads {}",
                (source / kStateFile).string(), head["format_version"].dump(), kFormatVersion);
  const Json& checksums = head["checksums"];
  return Checkpoint{
      ReadChecked(source / "model.safetensors", checksums), ReadChecked(source / "optimiser.safetensors", checksums),
      ReadChecked(source / "random.safetensors", checksums), head["state"], ReadSeconds(source / kTimeFile)};
}

}  // namespace daumier::train
