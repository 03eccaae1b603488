#pragma once
#include "core/task.h"

#include <filesystem>
#include <string>
#include <vector>

namespace daumier::studio {

/// A verb of the program with its arguments, run as a child.
class VerbRun {
 public:
  explicit VerbRun(std::vector<std::string> words) : words_(std::move(words)) {}

  void Add(const std::string& option, const std::string& value);
  void AddFlag(const std::string& flag, bool is_set);

  /// As a person types it into a shell.
  std::string CommandLine() const;

  /// Runs in the folder; `scratch` gets what it prints (core/child_process.h). Returns its standard output. @throws Error with what it
  /// wrote of its failure, or if the program is gone; Cancelled.
  std::string Run(const std::filesystem::path& program, const std::filesystem::path& folder,
                  const std::filesystem::path& scratch, const Task& task) const;

 private:
  std::vector<std::string> words_;
};

/// The name of a copy of a file in a job's folder, next to what the job writes there.
std::string NameOfCopy(const std::filesystem::path& file);
/// Copies a file into a job's folder under that name.
void CopyInto(const std::filesystem::path& folder, const std::filesystem::path& file);

}  // namespace daumier::studio
