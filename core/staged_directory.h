#pragma once
#include <filesystem>
#include <string>

namespace daumier {

/// A folder that is made whole under another name beside its place, then takes the place by renaming. Without Commit it
/// goes away.
class StagedDirectory {
 public:
  /// `kind` is the manifest kind of a folder that may be replaced. @throws Error if `target` holds anything else.
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
};

}  // namespace daumier
