#include "core/weights_folder.h"

#include "core/error.h"
#include "core/files.h"
#include "core/run_manifest.h"

namespace daumier {

namespace fs = std::filesystem;

namespace {

constexpr const char* kRestoreWeights =
    "Restore the folder from the release that it comes from, or make it again (tools/make_weights.sh)";

/// Absolute, without a slash at the end.
fs::path PlainPath(const fs::path& directory) {
  const fs::path path = fs::absolute(directory).lexically_normal();
  return path.has_filename() ? path : path.parent_path();
}

}  // namespace

std::string WeightsName(const fs::path& directory) {
  return PlainPath(directory).filename().string();
}

fs::path WeightsNextTo(const fs::path& directory, const std::string& name) {
  return PlainPath(directory).parent_path() / name;
}

bool IsWeightsFolder(const fs::path& directory) {
  std::error_code ignored;
  const fs::path file = directory / "manifest.json";
  if (!fs::is_regular_file(file, ignored)) return false;
  const Json manifest = TryParseJson(ReadFile(file)).value_or(Json());
  return manifest.is_object() && manifest.value("kind", Json()) == kWeightsKind;
}

void CheckNotDamaged(const fs::path& directory) {
  std::error_code ignored;
  const fs::path file = directory / "manifest.json";
  const Json manifest = fs::is_regular_file(file, ignored) ? TryParseJson(ReadFile(file)).value_or(Json()) : Json();
  const bool has_kind = manifest.is_object() && manifest.contains("kind");
  if (has_kind && (manifest.at("kind") == kWeightsKind || !fs::exists(directory / kWeightsNetwork, ignored))) return;
  for (fs::directory_iterator entry(directory, ignored), end; !ignored && entry != end; entry.increment(ignored))
    DAUMIER_CHECK(entry->path().extension() != ".safetensors",
                  "{}: weights whose manifest.json is missing or malformed. {}, or remove it", directory.string(),
                  kRestoreWeights);
}

Manifest ReadWeightsManifest(const fs::path& directory, const std::string& system) {
  Manifest manifest = ReadManifest(directory, kWeightsKind);
  const std::string file = (directory / "manifest.json").string();
  const Json version = manifest.details.value("weights_version", Json());
  DAUMIER_CHECK(version == kWeightsVersion,
                "{}: weights_version is {}, this program reads {}. Use the weights of this version of daumier, or the "
                "daumier that wrote them",
                file, version.dump(), kWeightsVersion);
  DAUMIER_CHECK(manifest.details.contains("system"), "{}: details.system is missing. {}", file, kRestoreWeights);
  const std::string found = SystemOf(manifest);
  DAUMIER_CHECK(system.empty() || found == system, "{}: these are weights of '{}' (expected of '{}'). Name others",
                directory.string(), found, system);
  return manifest;
}

Manifest ReadWeights(const fs::path& directory, const std::string& system, const std::vector<std::string>& files) {
  Manifest manifest = ReadWeightsManifest(directory, system);
  const std::string file = (directory / "manifest.json").string();
  std::vector<std::string> required = files;
  required.emplace_back(kWeightsCard);
  for (const std::string& name : required)
    DAUMIER_CHECK(manifest.checksums.contains(name), "{} does not list {}. {}", file, name, kRestoreWeights);
  for (const auto& [name, checksum] : manifest.checksums) {
    const fs::path path = directory / name;
    DAUMIER_CHECK(fs::is_regular_file(path), "{} is missing though manifest.json lists it. {}", path.string(),
                  kRestoreWeights);
    const std::string actual = Sha256OfFile(path);
    DAUMIER_CHECK(actual == checksum, "{} has changed: its SHA-256 is {} (expected {} as in manifest.json). {}",
                  path.string(), actual, checksum, kRestoreWeights);
  }
  return manifest;
}

fs::path NeededWeights(const fs::path& directory, const Manifest& manifest, const std::string& name) {
  const Json needs = manifest.details.value("needs", Json::object());
  DAUMIER_CHECK(needs.is_object() && needs.contains(name) && needs.at(name).is_string(),
                "{} does not list '{}' in details.needs. {}", (directory / "manifest.json").string(), name,
                kRestoreWeights);
  const fs::path needed = WeightsNextTo(directory, name);
  CheckNotDamaged(needed);
  DAUMIER_CHECK(IsWeightsFolder(needed), "{} needs the weights {}, which are {}. Put them there from the release",
                directory.string(), needed.string(), fs::exists(needed) ? "damaged" : "missing");
  const auto expected = needs.at(name).get<std::string>();
  const std::string found = DataHash(needed);
  DAUMIER_CHECK(found == expected,
                "{} needs other weights than those of {} (data hash {}, expected {}). Restore both from one release",
                directory.string(), needed.string(), found, expected);
  return needed;
}

}  // namespace daumier
