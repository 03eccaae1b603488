#include "core/log.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <atomic>

namespace daumier::log {
namespace {

std::atomic<Level> current_level = Level::kInfo;
std::atomic<int> num_warnings = 0;

spdlog::logger& Logger() {
  static const std::shared_ptr<spdlog::logger> logger = [] {
    auto made = std::make_shared<spdlog::logger>("daumier", std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
    // On a terminal this line may hold a progress line: clear it first.
    made->set_pattern(isatty(STDERR_FILENO) ? "\r\x1b[K%T %^%l%$ %v" : "%T %l %v");
    made->set_level(spdlog::level::trace);
    made->flush_on(spdlog::level::trace);
    return made;
  }();
  return *logger;
}

spdlog::level::level_enum ToSpdlog(Level level) {
  switch (level) {
    case Level::kDebug:
      return spdlog::level::debug;
    case Level::kInfo:
      return spdlog::level::info;
    case Level::kWarning:
      return spdlog::level::warn;
    case Level::kError:
      return spdlog::level::err;
    case Level::kOff:
      break;
  }
  return spdlog::level::off;
}

}  // namespace

void SetLevel(Level level) {
  current_level = level;
}

Level GetLevel() {
  return current_level;
}

void Write(Level level, const std::string& message) {
  if (level == Level::kWarning || level == Level::kError) ++num_warnings;
  if (level >= current_level && level != Level::kOff) Logger().log(ToSpdlog(level), message);
}

int NumWarnings() {
  return num_warnings;
}

}  // namespace daumier::log
