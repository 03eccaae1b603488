#include "core/manifest.h"

#include "core/error.h"
#include "core/files.h"

namespace daumier {
namespace fs = std::filesystem;
namespace {

const char* const kFileName = "manifest.json";
const char* const kRestore = "Restore the file from a copy, or delete the folder and make it again";

/// The field. @throws Error if it is missing or `is_type` is false for it.
const Json& Field(const Json& json, const char* name, bool (Json::*is_type)() const noexcept) {
  const auto found = json.find(name);
  DAUMIER_CHECK(found != json.end(), "'{}' is missing", name);
  DAUMIER_CHECK(((*found).*is_type)(), "'{}' has the wrong type", name);
  return *found;
}

Manifest Parse(const Json& json) {
  DAUMIER_CHECK(json.is_object(), "the file is no JSON object. {}", kRestore);
  const Json& version = Field(json, "format_version", &Json::is_number_integer);
  DAUMIER_CHECK(version <= Manifest::kFormatVersion,
                "format version {} is newer than this program, which reads version {}; use the daumier that wrote it",
                version.dump(), Manifest::kFormatVersion);
  DAUMIER_CHECK(version == Manifest::kFormatVersion, "format version {} is unknown, this program reads version {}",
                version.dump(), Manifest::kFormatVersion);
  Manifest manifest;
  manifest.kind = Field(json, "kind", &Json::is_string).get<std::string>();
  manifest.verb = Field(json, "verb", &Json::is_string).get<std::string>();
  manifest.config = Field(json, "config", &Json::is_object);
  manifest.seed = Field(json, "seed", &Json::is_number_unsigned).get<uint64_t>();
  manifest.sources = Field(json, "sources", &Json::is_array);
  manifest.counts = Field(json, "counts", &Json::is_object);
  manifest.details = Field(json, "details", &Json::is_object);
  for (const auto& [name, checksum] : Field(json, "checksums", &Json::is_object).items()) {
    DAUMIER_CHECK(checksum.is_string(), "checksum of '{}' is no text", name);
    const fs::path file(name);
    DAUMIER_CHECK(file.is_relative() && *file.lexically_normal().begin() != "..", "'{}' lies outside of the folder",
                  name);
    manifest.checksums[name] = checksum.get<std::string>();
  }
  return manifest;
}

/// How to get a folder of that kind.
std::string Repair(const std::string& kind, const std::string& folder) {
  if (kind == "faces" || kind == "sketches" || kind == "points")
    return fmt::format("Make one with `daumier dataset {} --out {}`, or name another folder", kind, folder);
  if (kind == "run")
    return fmt::format("Make one with `daumier train CONFIG --out {}`, or name another folder", folder);
  return "Name another folder";
}

/// "a folder of faces", "a run folder".
std::string FolderOf(const std::string& kind) {
  return kind == "run" ? "a run folder" : fmt::format("a folder of {}", kind);
}

/// @throws Error naming the folder, what is missing and the repair.
void CheckIsThere(const fs::path& directory, const std::string& kind) {
  if (fs::exists(directory / kFileName)) return;
  const std::string folder = directory.string(),
                    expected = kind.empty() ? "a folder that daumier wrote" : FolderOf(kind);
  if (fs::exists(directory) && !fs::is_directory(directory))
    throw Error(fmt::format("{} is a file (expected {}). Name the folder", folder, expected));
  if (!fs::exists(directory))
    throw Error(fmt::format("{} does not exist (expected {}). {}", folder, expected, Repair(kind, folder)));
  if (fs::exists(directory / kBuildJournal))
    throw Error(
        fmt::format("{} is not finished (manifest.json is missing). The command that builds it resumes it", folder));
  throw Error(fmt::format("{} is not {} (manifest.json is missing). {}", folder, expected, Repair(kind, folder)));
}

}  // namespace

void WriteManifest(const fs::path& directory, const Manifest& manifest) {
  Json json;
  json["format_version"] = Manifest::kFormatVersion;
  json["kind"] = manifest.kind;
  json["verb"] = manifest.verb;
  json["config"] = manifest.config;
  json["seed"] = manifest.seed;
  json["sources"] = manifest.sources;
  json["counts"] = manifest.counts;
  json["details"] = manifest.details;
  json["checksums"] = Json(manifest.checksums);
  WriteFileIfChanged(directory / kFileName, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

Manifest ReadManifest(const fs::path& directory, const std::string& kind) {
  CheckIsThere(directory, kind);
  const fs::path path = directory / kFileName;
  Json json;
  try {
    json = ReadJson(path);
  } catch (const Error& error) {
    throw Error(fmt::format("{}. {}", error.what(), kRestore));
  }
  Manifest manifest;
  try {
    manifest = Parse(json);
  } catch (const Error& error) {
    throw Error(fmt::format("cannot read {}: {}", path.string(), error.what()));
  }
  DAUMIER_CHECK(kind.empty() || manifest.kind == kind, "{}: this is {}, expected {}. {}", directory.string(),
                FolderOf(manifest.kind), FolderOf(kind), Repair(kind, "FOLDER"));
  return manifest;
}

void VerifyChecksums(const fs::path& directory, const Manifest& manifest) {
  const std::string remedy = fmt::format("delete the folder and run `daumier {}` again", manifest.verb);
  for (const auto& [name, checksum] : manifest.checksums) {
    const fs::path path = directory / name;
    DAUMIER_CHECK(fs::is_regular_file(path), "{} is missing though manifest.json lists it; {}", path.string(), remedy);
    DAUMIER_CHECK(Sha256OfFile(path) == checksum, "{} is corrupt: its checksum differs from that in manifest.json; {}",
                  path.string(), remedy);
  }
}

std::string DataHash(const fs::path& directory) {
  CheckIsThere(directory, "");
  return Sha256OfFile(directory / kFileName);
}

}  // namespace daumier
