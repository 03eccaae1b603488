#pragma once
#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace daumier::testing {

struct ProcessResult {
  int exit_code = -1;  ///< -1 if a signal ended it.
  int signal = 0;
  std::string out, err;
};

/// Runs a program to its end. `kill_when` and `kill_signal`: as soon as that path exists, the signal is sent.
ProcessResult RunProcess(const std::vector<std::string>& arguments, const std::filesystem::path& kill_when = {},
                         int kill_signal = 0);

}  // namespace daumier::testing
