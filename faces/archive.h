#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace daumier::faces {

/// Far above any face data; a hostile header may claim more.
inline constexpr int64_t kLargestEntry = int64_t{1} << 32;

/// Gives every regular file of a folder (recursively, in order of name) or of a tar archive (plain, or compressed by
/// gzip, xz or zstd) or a zip archive (in its own order) whose path `wanted` accepts to `use`, path and content. Paths
/// are relative, with forward slashes. Left out: IsSystemFile. A wanted file of an archive has at most `largest` bytes.
/// @throws Error naming path and cause: missing, not an archive, truncated or corrupt, or a larger file.
void ForEachFile(const std::filesystem::path& folder_or_archive,
                 const std::function<bool(const std::string& path)>& wanted,
                 const std::function<void(const std::string& path, std::string_view content)>& use,
                 int64_t largest = kLargestEntry);

}  // namespace daumier::faces
