#pragma once
#include "core/folder_lock.h"

#include <filesystem>
#include <optional>
#include <string>

namespace daumier {

/// A folder that is written under a temporary name next to its target, .NAME.daumier-partial, and takes its place on
/// Commit. Without Commit it is deleted. One writer at a time: others wait (FolderLock).
class StagedDirectory {
 public:
  /// `kind` is the manifest kind of a folder that may be replaced. @throws UsageError as CheckReplacedFolder.
  StagedDirectory(const std::filesystem::path& target, const std::string& kind);
  ~StagedDirectory();
  StagedDirectory(const StagedDirectory&) = delete;
  StagedDirectory& operator=(const StagedDirectory&) = delete;

  /// Where to write.
  const std::filesystem::path& path() const { return path_; }
  /// Renames to the target. @throws Error naming the path and the cause.
  void Commit();

 private:
  std::filesystem::path target_, path_;
  std::optional<FolderLock> lock_;
  bool is_committed_ = false;
};

}  // namespace daumier
