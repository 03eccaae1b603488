#pragma once
#include <filesystem>
#include <span>
#include <string_view>

namespace daumier::fuzz {

/// A reader of files from strangers. Whatever the bytes, it returns or throws daumier::Error.
struct Target {
  std::string_view name;  ///< Of `./dev fuzz NAME` and of the folder tests/fuzz/seeds/NAME.
  std::string_view file;  ///< Name of the file, since readers go by suffixes.
  void (*read)(const std::filesystem::path&);
};

std::span<const Target> Targets();

/// @throws UsageError listing the names if there is none of this name.
const Target& FindTarget(std::string_view name);

/// Writes the bytes to `folder / target.file` and reads them. daumier::Error is what bad input gives, and is caught;
/// every other exception leaves.
void ReadBytes(const Target& target, std::string_view bytes, const std::filesystem::path& folder);

}  // namespace daumier::fuzz
