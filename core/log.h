#pragma once
#include <fmt/format.h>

#include <string>
#include <utility>

/// One log to stderr. Results go to stdout and never through here.
namespace daumier::log {

enum class Level { kDebug, kInfo, kWarning, kError, kOff };

/// Messages below `level` are not written. The program begins with kInfo.
void SetLevel(Level level);
Level GetLevel();
void Write(Level level, const std::string& message);
/// Warnings and errors since the program began, whether the level let them through or not; a test fails if it grows.
int NumWarnings();

template <class... Args>
void Info(fmt::format_string<Args...> format, Args&&... args) {
  Write(Level::kInfo, fmt::format(format, std::forward<Args>(args)...));
}
template <class... Args>
void Warn(fmt::format_string<Args...> format, Args&&... args) {
  Write(Level::kWarning, fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace daumier::log
