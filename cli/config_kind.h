#pragma once
#include "cli/verb.h"
#include "core/error.h"

#include <string>

namespace daumier::cli {

/// The command that reads a config, by its keys: "dataset faces", "train", "ablate". Empty if there is none, or several.
std::string CommandOfConfig(const Json& config);

/// @throws UsageError naming the command that the config file is for, if that is another one than `command`; else
/// `error`.
[[noreturn]] void FailOnConfig(const UsageError& error, const std::filesystem::path& file, const std::string& command);

/// parse(), which reads the config `file` of `command`. An error about a config of another command names that one.
template <class Parse>
decltype(auto) ReadConfigOf(const std::string& command, const std::filesystem::path& file, const Parse& parse) {
  try {
    return parse();
  } catch (const UsageError& error) {
    FailOnConfig(error, file, command);
  }
}

}  // namespace daumier::cli
