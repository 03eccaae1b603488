#include "core/run_manifest.h"

#include "core/config.h"
#include "core/config_differences.h"
#include "core/error.h"
#include "core/training.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

namespace daumier {

namespace fs = std::filesystem;

namespace {

/// A path as a word of a shell command.
std::string ShellWord(const std::string& path) {
  const bool is_plain = !path.empty() && std::ranges::all_of(path, [](unsigned char c) {
    return std::isalnum(c) || c >= 0x80 || std::string_view("/._-+,:@%").find(char(c)) != std::string_view::npos;
  });
  if (is_plain) return path;
  std::string quoted = "'";
  for (const char c : path) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

/// @throws Error unless the options of resolved.toml, but for the folders of data, are those of the manifest. An option
/// that the manifest lacks is newer than the run.
void CheckUnedited(const Json& config, const fs::path& directory, const Manifest& run) {
  Json there = run.config, now = config;
  for (const char* key : {"data", "system", "product"}) there.erase(key), now.erase(key);
  const std::vector<std::string> lines = ConfigDifferences(there, now, now);
  DAUMIER_CHECK(
      lines.empty(),
      "{} was edited: the run was trained with other options, which manifest.json in its folder holds "
      "(there):\n  {}\nWrite the values of manifest.json into it; only data.* may change. To train with other "
      "options, copy it and run `daumier train COPY.toml --out OTHER_FOLDER`",
      ResolvedConfig(directory).string(), fmt::join(lines, "\n  "));
}

}  // namespace

std::string SystemOf(const Manifest& run) {
  const char* const key = run.details.contains("system") ? "system" : "product";
  if (!run.details.contains(key)) return "sketch";
  const Json& system = run.details.at(key);
  DAUMIER_CHECK(system.is_string(), "the manifest of the run names the task {} (expected a text). Train again",
                system.dump());
  return system.get<std::string>();
}

std::string ResumeCommand(const fs::path& directory, const std::string& extra) {
  std::string command = fmt::format("daumier train {} --out {} --resume", ShellWord(ResolvedConfig(directory).string()),
                                    ShellWord(directory.string()));
  if (!extra.empty()) command += " " + extra;
  return command;
}

void CheckDataIsThere(const Json& config, const fs::path& directory) {
  for (const auto& [database, folder] : config.at("data").items()) {
    const fs::path path = folder.get<std::string>();
    if (path.empty() || fs::exists(path)) continue;
    throw UsageError(
        fmt::format("{} does not exist (expected the {} that {} is trained on). If they have moved, add data.{}=FOLDER",
                    path.string(), database, directory.string(), database));
  }
}

Json ReadRunConfig(const fs::path& directory, const Manifest& run) {
  Json config = LoadConfig(ResolvedConfig(directory));
  CheckUnedited(config, directory, run);
  if (!config.contains("system") && !config.contains("product")) return config;  // Of an early version.
  const std::string expected = SystemOf(run), found = SystemOfConfig(config, ResolvedConfig(directory).string());
  DAUMIER_CHECK(found == expected,
                "{} is the config of a run of '{}', but manifest.json next to it is of a run of '{}'. Restore the file "
                "of the run, or train again",
                ResolvedConfig(directory).string(), found, expected);
  return config;
}

Manifest ReadFinishedRun(const fs::path& directory, const std::string& system) {
  DAUMIER_CHECK(!fs::exists(directory) || fs::is_directory(directory),
                "{} is a file (expected a run folder, which `daumier train` writes). Name the folder",
                directory.string());
  DAUMIER_CHECK(fs::exists(directory / "manifest.json"),
                "{} is not a run folder (manifest.json is missing): make one with `daumier train CONFIG --out {}`",
                directory.string(), directory.string());
  Manifest manifest = ReadManifest(directory, "run");
  const std::string found = SystemOf(manifest);
  DAUMIER_CHECK(system.empty() || found == system,
                "{}: this is a run of the task '{}' (expected a run of '{}'). Name a run that was trained for '{}'",
                directory.string(), found, system, system);
  DAUMIER_CHECK(fs::exists(BestWeights(directory)), "{} has no best weights yet ({} is missing): resume it with `{}`",
                directory.string(), BestWeights(directory).string(), ResumeCommand(directory));
  VerifyChecksums(directory, manifest);
  return manifest;
}

}  // namespace daumier
