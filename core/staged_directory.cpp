#include "core/staged_directory.h"

#include "core/error.h"
#include "core/files.h"
#include "core/output_place.h"

#include <fcntl.h>

#include <cstdio>

namespace daumier {
namespace {

namespace fs = std::filesystem;

void Rename(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  DAUMIER_CHECK(!error, "cannot rename {} to {}: {}", from.string(), to.string(), error.message());
}

/// Exchanges two folders at once, so that a program that is killed leaves one of them whole. False where the file system
/// cannot.
bool Exchanged(const fs::path& a, const fs::path& b) {
  return renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0;
}

void RemoveContent(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder)) fs::remove_all(entry.path());
}

fs::path SiblingPath(const fs::path& target, const std::string& extension) {
  return target.parent_path() / ("." + target.filename().string() + extension);
}

}  // namespace

StagedDirectory::StagedDirectory(const fs::path& target, const std::string& kind) {
  // The folder that a link names is written, and the link stays.
  target_ = fs::weakly_canonical(fs::absolute(target)).lexically_normal();
  if (target_.filename().empty()) target_ = target_.parent_path();
  path_ = SiblingPath(target_, ".daumier-partial");
  lock_.emplace(path_);
  try {
    CheckReplacedFolder(target_, kind);  // Locked, for another program may just have written it.
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    throw;
  }
  RemoveContent(path_);  // Of a program that was killed.
}

StagedDirectory::~StagedDirectory() {
  std::error_code ignored;
  if (!is_committed_) fs::remove_all(path_, ignored);
}

void StagedDirectory::Commit() {
  if (!fs::exists(target_)) {
    Rename(path_, target_);
  } else {
    const FolderLock earlier(target_);  // Until it is gone, so that nobody takes it for a folder that is being written.
    if (Exchanged(path_, target_)) {
      fs::remove_all(path_);
    } else {
      const fs::path old = SiblingPath(target_, ".daumier-old");
      fs::remove_all(old);
      Rename(target_, old);
      Rename(path_, target_);
      fs::remove_all(old);
    }
  }
  is_committed_ = true;
}

}  // namespace daumier
