#pragma once
#include "core/task.h"

#include <filesystem>

namespace daumier {

/// One writer at a time in a folder. The lock is the folder's own (flock): it leaves no file and ends with its process,
/// however that ends. File systems without locks lock nothing.
class FolderLock {
 public:
  /// Makes the folder where it is missing, and waits while another lock of it exists, in this process or another.
  /// @throws Error if the folder cannot be made or opened; Cancelled if the task is while it waits.
  explicit FolderLock(const std::filesystem::path& folder, const Task& task = {});
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace daumier
