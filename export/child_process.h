#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace daumier::exporting {

struct ChildResult {
  int exit_code = 0;
  std::string out, err;
};

/// Runs a program, found on PATH, with these arguments (no shell) until it ends; what it prints passes through files in
/// `scratch`. Nothing if there is no such program. @throws Error if a signal ends it, or if it has not ended after
/// `timeout_seconds`: it is killed then.
std::optional<ChildResult> RunChild(const std::vector<std::string>& arguments, const std::filesystem::path& scratch,
                                    double timeout_seconds);

}  // namespace daumier::exporting
