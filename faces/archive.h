#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace daumier::faces {

/// Gives every regular file of a folder (recursively, in order of name) or of a tar archive (plain, or compressed by
/// gzip, xz or zstd) or a zip archive (in its own order) whose path `wanted` accepts to `use`, path and content. Paths
/// are relative, with forward slashes. Left out: IsSystemFile.
/// @throws Error naming path and cause: missing, not an archive, truncated or corrupt.
void ForEachFile(const std::filesystem::path& folder_or_archive,
                 const std::function<bool(const std::string& path)>& wanted,
                 const std::function<void(const std::string& path, std::string_view content)>& use);

}  // namespace daumier::faces
