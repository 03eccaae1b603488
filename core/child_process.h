#pragma once
#include "core/task.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace daumier {

struct ChildResult {
  int exit_code = 0;
  std::string out, err;
};

/// Where a child runs and when it is ended.
struct ChildOptions {
  double timeout_seconds = 3600;
  std::filesystem::path folder = {};  ///< It is in this folder; empty: in ours.
  Task task = {};                     ///< If it is cancelled, the child gets SIGTERM, and SIGKILL after kGrace seconds.

  static constexpr double kGrace = 1;
};

/// Runs a program, found on PATH, with these arguments (no shell) until it ends; what it prints passes through the files
/// child.out and child.err in `scratch`. Nothing if there is no such program. @throws Error if a signal ends it, or if it has not
/// ended after timeout_seconds: it is killed then; Cancelled if the task is, once the child has ended.
std::optional<ChildResult> RunChild(const std::vector<std::string>& arguments, const std::filesystem::path& scratch,
                                    const ChildOptions& options);

}  // namespace daumier
