#include "core/folder_lock.h"

#include "core/error.h"
#include "core/files.h"
#include "core/log.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

namespace daumier {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kPause{20};

/// Whether the folder of that name is the opened one: another writer may have removed it since.
bool IsStillThere(int descriptor, const fs::path& folder) {
  struct stat opened = {}, named = {};
  return fstat(descriptor, &opened) == 0 && stat(folder.c_str(), &named) == 0 && opened.st_dev == named.st_dev &&
         opened.st_ino == named.st_ino;
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder, const Task& task) {
  bool is_told = false;
  for (;;) {
    MakeDirectory(folder);
    descriptor_ = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const bool is_gone = descriptor_ < 0 && errno == ENOENT;  // Removed since it was made.
    DAUMIER_CHECK(descriptor_ >= 0 || is_gone,
                  "cannot open the folder {}: {}. Name another one, or change its permissions", folder.string(),
                  std::strerror(errno));
    if (is_gone) continue;
    const bool is_busy = flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    if (!is_busy && IsStillThere(descriptor_, folder)) return;
    close(descriptor_);
    descriptor_ = -1;
    if (!is_busy) continue;
    if (!is_told) log::Info("{} is being written by another program; waiting until it ends", folder.string());
    is_told = true;
    task.ThrowIfCancelled("stopped while another program wrote into {}", folder.string());
    std::this_thread::sleep_for(kPause);
  }
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

}  // namespace daumier
