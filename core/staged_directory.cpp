#include "core/staged_directory.h"

#include "core/error.h"
#include "core/files.h"
#include "core/output_place.h"

namespace daumier {
namespace {

namespace fs = std::filesystem;

void Rename(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  DAUMIER_CHECK(!error, "cannot rename {} to {}: {}", from.string(), to.string(), error.message());
}

fs::path SiblingPath(const fs::path& target, const std::string& extension) {
  return target.parent_path() / ("." + target.filename().string() + extension);
}

}  // namespace

StagedDirectory::StagedDirectory(const fs::path& target, const std::string& kind) {
  // The folder that a link names is written, and the link stays.
  target_ = fs::weakly_canonical(fs::absolute(target)).lexically_normal();
  if (target_.filename().empty()) target_ = target_.parent_path();
  path_ = SiblingPath(target_, ".partial");
  CheckReplacedFolder(target_, kind);
  fs::remove_all(path_);
  MakeDirectory(path_);
}

StagedDirectory::~StagedDirectory() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

void StagedDirectory::Commit() {
  const fs::path old = SiblingPath(target_, ".old");
  fs::remove_all(old);
  if (fs::exists(target_)) Rename(target_, old);
  Rename(path_, target_);
  fs::remove_all(old);
}

}  // namespace daumier
