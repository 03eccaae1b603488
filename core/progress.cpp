#include "core/progress.h"

#include "core/log.h"
#include "core/process_task.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>

namespace daumier {

using Clock = std::chrono::steady_clock;

ProgressPrinter::ProgressPrinter() : terminal_(isatty(STDERR_FILENO) == 1) {}

ProgressPrinter::~ProgressPrinter() {
  if (is_open_) PrintLine(true);
}

void ProgressPrinter::Print(const TaskProgress& progress) {
  const std::lock_guard lock(mutex_);
  const bool is_new = stage_ != progress.stage || unit_ != progress.unit || total_ != progress.total ||
                      (progress.done == 0 && done_ > 0);
  if (is_new) {
    if (is_open_) PrintLine(true);
    stage_ = progress.stage;
    unit_ = progress.unit;
    total_ = progress.total;
    first_ = progress.done;
    start_ = last_print_ = Clock::now();
    is_open_ = true;
  }
  done_ = progress.done;
  note_ = progress.note;
  if (!is_open_) return;
  const auto interval = terminal_ ? std::chrono::milliseconds(500) : std::chrono::seconds(10);
  if (done_ >= total_) {
    PrintLine(true);
  } else if (Clock::now() - last_print_ >= interval) {
    PrintLine(false);
  }
}

void ProgressPrinter::PrintLine(bool last) {
  last_print_ = Clock::now();
  is_open_ = !last;
  if (log::GetLevel() > log::Level::kInfo) return;
  const double seconds = std::chrono::duration<double>(last_print_ - start_).count();
  std::string line = ProgressLine(stage_, done_, total_, unit_, seconds, first_);
  if (!note_.empty()) line += fmt::format("  {}", note_);
  fmt::print(stderr, "{}{}{}", terminal_ ? "\r\x1b[K" : "", line, terminal_ && !last ? "" : "\n");
  std::fflush(stderr);
}

Progress::Progress(Task task, int64_t total, std::string unit, int64_t done)
    : task_(std::move(task)), total_(total), unit_(std::move(unit)), done_(done) {
  task_.Report(done_, total_, unit_);
}

Progress::Progress(std::string stage, int64_t total, std::string unit)
    : Progress(TaskOfProcess().Stage(std::move(stage)), total, std::move(unit)) {}

void Progress::Step(int64_t count, const std::string& note) {
  const std::lock_guard lock(mutex_);
  done_ += count;
  if (!note.empty()) note_ = note;
  task_.Report(done_, total_, unit_, note_);
}

std::string ProgressLine(const std::string& stage, int64_t done, int64_t total, const std::string& unit, double seconds,
                         int64_t first) {
  const double rate = seconds > 0 ? static_cast<double>(done - first) / seconds : 0;
  const std::string speed = rate >= 100 ? fmt::format("{:.0f}/s", rate) : fmt::format("{:.3g}/s", rate);
  const std::string head = fmt::format("{}{}{}/{} {}, {}", stage, stage.empty() ? "" : ": ", done, total, unit, speed);
  if (done >= total) return fmt::format("{}, took {}", head, FormatDuration(seconds));
  if (done <= first) return head;
  return fmt::format("{}, {} left", head, FormatDuration(static_cast<double>(total - done) / rate));
}

std::string FormatDuration(double seconds) {
  const auto total = static_cast<int64_t>(std::llround(seconds));
  if (total < 60) return fmt::format("{} s", total);
  if (total < 3600) return fmt::format("{} min {:02} s", total / 60, total % 60);
  return fmt::format("{} h {:02} min", total / 3600, total % 3600 / 60);
}

}  // namespace daumier
