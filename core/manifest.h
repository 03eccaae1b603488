#pragma once
#include "core/json.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace daumier {

/// manifest.json of every directory that Daumier writes. Holds no clock, path or host name, so that equal work gives
/// equal bytes.
struct Manifest {
  static constexpr int kFormatVersion = 1;

  std::string kind;              ///< What the directory is: "faces", "sketches", "run", "report", "predictions".
  std::string verb;              ///< The command that made it.
  Json config = Json::object();  ///< Resolved, without paths.
  uint64_t seed = 0;
  Json sources = Json::array();  ///< [{name, version, checksum, licence}, ...]: where the data come from.
  Json counts = Json::object();
  Json details = Json::object();                 ///< What else a reader or a test needs, by kind.
  std::map<std::string, std::string> checksums;  ///< File name relative to the directory -> SHA-256.
};

/// What a builder keeps in the place of the manifest until its folder is finished.
inline constexpr const char* kBuildJournal = "building.json";

/// Atomic; a manifest that has the same bytes already is not touched.
void WriteManifest(const std::filesystem::path& directory, const Manifest& manifest);

/// @throws Error naming file, cause and repair: missing (also of a build that was stopped), malformed, of another kind (unless `kind` is empty), or of a newer
/// version.
Manifest ReadManifest(const std::filesystem::path& directory, const std::string& kind);

/// Whether a folder's files are compared with the checksums of its manifest when it is opened.
enum class Checksums { kVerify, kSkip };

/// @throws Error naming the first file that is missing or whose content differs, and how to remake it.
void VerifyChecksums(const std::filesystem::path& directory, const Manifest& manifest);

/// The manifest's own checksum: names this exact data in results.
std::string DataHash(const std::filesystem::path& directory);

}  // namespace daumier
