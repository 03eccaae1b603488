#include "core/progress.h"

#include "core/log.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>

namespace daumier {

using Clock = std::chrono::steady_clock;

Progress::Progress(std::string label, int64_t total, std::string unit)
    : label_(std::move(label)),
      unit_(std::move(unit)),
      total_(total),
      terminal_(isatty(STDERR_FILENO) == 1),
      start_(Clock::now()),
      last_print_(start_) {}

Progress::~Progress() {
  Print(true);
}

void Progress::Step(int64_t count, const std::string& note) {
  const std::lock_guard lock(mutex_);
  done_ += count;
  if (!note.empty()) note_ = note;
  const auto interval = terminal_ ? std::chrono::milliseconds(500) : std::chrono::seconds(10);
  if (Clock::now() - last_print_ >= interval) Print(false);
}

void Progress::Print(bool last) {
  last_print_ = Clock::now();
  if (log::GetLevel() > log::Level::kInfo) return;
  const double seconds = std::chrono::duration<double>(last_print_ - start_).count();
  std::string line = ProgressLine(label_, done_, total_, unit_, seconds);
  if (!note_.empty()) line += fmt::format("  {}", note_);
  fmt::print(stderr, "{}{}{}", terminal_ ? "\r\x1b[K" : "", line, terminal_ && !last ? "" : "\n");
  std::fflush(stderr);
}

std::string ProgressLine(const std::string& label, int64_t done, int64_t total, const std::string& unit,
                         double seconds) {
  const double rate = seconds > 0 ? static_cast<double>(done) / seconds : 0;
  const std::string speed = rate >= 100 ? fmt::format("{:.0f}/s", rate) : fmt::format("{:.3g}/s", rate);
  const std::string head = fmt::format("{}: {}/{} {}, {}", label, done, total, unit, speed);
  if (done >= total) return fmt::format("{}, took {}", head, FormatDuration(seconds));
  if (done == 0) return head;
  return fmt::format("{}, {} left", head, FormatDuration(static_cast<double>(total - done) / rate));
}

std::string FormatDuration(double seconds) {
  const auto total = static_cast<int64_t>(std::llround(seconds));
  if (total < 60) return fmt::format("{} s", total);
  if (total < 3600) return fmt::format("{} min {:02} s", total / 60, total % 60);
  return fmt::format("{} h {:02} min", total / 3600, total % 3600 / 60);
}

}  // namespace daumier
