#include "core/output_place.h"

#include "core/error.h"
#include "core/files.h"
#include "core/manifest.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>

namespace daumier {
namespace {

namespace fs = std::filesystem;

constexpr const char* kManifestFile = "manifest.json";

bool IsOfTheDesktop(const std::string& name) {
  return name.starts_with("._") || name == ".DS_Store" || name == "Thumbs.db" || name == "desktop.ini";
}

/// The first entry that counts as content, by name.
std::optional<fs::path> FirstEntry(const fs::path& folder, const OutputKind& kind) {
  const auto counts = [&](const std::string& name) {
    if (IsOfTheDesktop(name) || IsTemporaryNameOf(name, kManifestFile)) return false;
    return std::ranges::none_of(kind.begun, [&](const std::string& file) { return IsTemporaryNameOf(name, file); });
  };
  std::optional<fs::path> first;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path name = entry.path().filename();
    if (counts(name.string()) && (!first || name < *first)) first = name;
  }
  return first;
}

/// Absent if there is no manifest or another program's.
std::optional<Manifest> ManifestIn(const fs::path& folder) {
  if (!fs::exists(folder / kManifestFile)) return std::nullopt;
  try {
    return ReadManifest(folder, "");
  } catch (const Error&) {
    return std::nullopt;
  }
}

/// Whether `input` is `folder` or lies below it.
bool LiesIn(const fs::path& input, const fs::path& folder) {
  std::error_code ignored;
  for (fs::path path : {fs::absolute(input).lexically_normal(), fs::weakly_canonical(input, ignored)}) {
    for (;;) {
      if (fs::equivalent(path, folder, ignored)) return true;
      if (!path.has_parent_path() || path == path.parent_path()) break;
      path = path.parent_path();
    }
  }
  return false;
}

/// @throws if no folder can be made at `out`, which does not exist.
void CheckCanBeMade(const fs::path& out) {
  if (fs::is_symlink(out))
    throw UsageError(fmt::format("{} is a link to a file that does not exist. Name another folder", out.string()));
  std::error_code error;
  fs::path parent = fs::absolute(out).lexically_normal(), missing = parent;
  while (!fs::exists(parent, error)) {
    if (parent.has_filename()) missing = parent;  // Not so behind a trailing slash.
    parent = parent.parent_path();
  }
  if (!fs::is_directory(parent))
    throw UsageError(
        fmt::format("{} cannot be a folder, for {} is a file. Name another folder", out.string(), parent.string()));
  // Whether it can be made is known for certain only by making one: some file systems refuse whatever the permissions
  // say. Not of its own name, which another program may be making.
  const fs::path probe = fmt::format("{}.{}", missing.string(), getpid());
  const bool is_made = fs::create_directory(probe, error);
  DAUMIER_CHECK(!error, "cannot write into {}: {}. Name another folder", parent.string(), error.message());
  if (is_made) fs::remove(probe, error);
}

bool IsBegun(const fs::path& folder, const OutputKind& kind) {
  return !kind.begun.empty() &&
         std::ranges::all_of(kind.begun, [&](const std::string& file) { return fs::exists(folder / file); });
}

void CheckContent(const fs::path& out, const OutputKind& kind) {
  const std::optional<fs::path> first = FirstEntry(out, kind);
  if (!first) return;
  const std::optional<Manifest> manifest = ManifestIn(out);
  if (manifest ? manifest->kind == kind.name : IsBegun(out, kind)) return;
  const std::string found =
      manifest ? fmt::format("it is a folder of {}", manifest->kind) : fmt::format("it has '{}'", first->string());
  throw UsageError(
      fmt::format("{} is not empty and holds no earlier {} ({}); name another folder", out.string(), kind.name, found));
}

bool IsUnfinished(const Manifest& manifest, const std::string& name) {
  const auto listed = manifest.details.find(kUnfinishedFiles);
  return listed != manifest.details.end() && listed->is_array() && std::ranges::count(*listed, Json(name)) > 0;
}

/// @throws UsageError unless the file is absent or as the manifest lists it.
void CheckOwnFile(const fs::path& folder, const std::string& name, const std::optional<Manifest>& manifest) {
  const fs::path file = folder / name;
  if (!fs::exists(fs::symlink_status(file))) return;
  const auto refuse = [&](const char* why) {
    throw UsageError(fmt::format("{} {} and would be lost. Move it, or name another folder", file.string(), why));
  };
  if (manifest && IsUnfinished(*manifest, name) && fs::is_regular_file(file)) return;
  if (!manifest || manifest->checksums.count(name) == 0) refuse("is not listed in the manifest of its folder");
  if (!fs::is_regular_file(file) || Sha256OfFile(file) != manifest->checksums.at(name))
    refuse("has changed since it was written");
}

}  // namespace

void CheckOutputFolder(const fs::path& out, const OutputKind& kind, const std::vector<fs::path>& inputs) {
  if (out.empty()) throw UsageError("the name of the folder to write is empty. Name a folder");
  if (!fs::exists(out)) return CheckCanBeMade(out);
  if (!fs::is_directory(out)) throw UsageError(fmt::format("{} is a file; name a folder to write", out.string()));
  CheckContent(out, kind);
  for (const fs::path& input : inputs) {
    if (!input.empty() && LiesIn(input, out))
      throw UsageError(
          fmt::format("{} lies in the folder to write, {}. Name another folder", input.string(), out.string()));
  }
  DAUMIER_CHECK(access(out.c_str(), W_OK | X_OK) == 0, "cannot write into {}: {}. Name another folder", out.string(),
                std::strerror(errno));
}

void CheckReplacedFolder(const fs::path& out, const std::string& kind, const std::vector<fs::path>& inputs) {
  CheckOutputFolder(out, {kind}, inputs);
  if (!fs::exists(out)) return;
  const std::optional<Manifest> manifest = ManifestIn(out);
  for (const auto& entry : fs::recursive_directory_iterator(out)) {
    const std::string name = fs::relative(entry.path(), out).generic_string();
    const std::string last = entry.path().filename().string();
    const bool is_own = name == kManifestFile || IsTemporaryNameOf(name, kManifestFile) || IsOfTheDesktop(last);
    if (!is_own && (entry.is_symlink() || !entry.is_directory())) CheckOwnFile(out, name, manifest);
  }
}

void CheckOwnFiles(const fs::path& folder, const std::vector<std::string>& names) {
  if (!fs::exists(folder)) return;
  const std::optional<Manifest> manifest = ManifestIn(folder);
  for (const std::string& name : names) CheckOwnFile(folder, name, manifest);
}

void CheckOutputFile(const fs::path& file, ExistingFile existing, const std::vector<fs::path>& inputs) {
  if (!file.has_filename()) throw UsageError(fmt::format("'{}' is no name of a file to write", file.string()));
  if (fs::is_directory(file)) throw UsageError(fmt::format("{} is a folder; name a file to write", file.string()));
  const fs::path folder = fs::absolute(file).parent_path();
  if (!fs::is_directory(folder))
    throw UsageError(fmt::format("{} cannot be written: {} is no folder. Make it, or name another file", file.string(),
                                 folder.string()));
  std::error_code ignored;
  for (const fs::path& input : inputs) {
    if (fs::equivalent(input, file, ignored))
      throw UsageError(fmt::format("{} is the input and would be overwritten. Name another file", file.string()));
  }
  if (existing == ExistingFile::kKept && fs::exists(fs::symlink_status(file)))
    throw UsageError(fmt::format(
        "{} exists and is no earlier result of this command. Name another file, or add --force", file.string()));
}

}  // namespace daumier
