#pragma once
#include "core/task.h"

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

namespace daumier {

/// Prints reports on stderr with rate and ETA: one line redrawn at most twice a second on a terminal, plain lines every
/// ten seconds elsewhere. A stage ends with a last line, at the latest when the next stage begins or the printer is
/// destroyed. The rate is that since the first report of the stage. Silent if the log's level is above kInfo.
/// Thread-safe.
class ProgressPrinter {
 public:
  ProgressPrinter();
  ~ProgressPrinter();
  ProgressPrinter(const ProgressPrinter&) = delete;
  ProgressPrinter& operator=(const ProgressPrinter&) = delete;
  /// A stage, total or unit other than the last report's begins a new line, and so does a count that returns to 0.
  void Print(const TaskProgress& progress);

 private:
  void PrintLine(bool last);

  std::mutex mutex_;
  const bool terminal_;
  bool is_open_ = false;  ///< Between the first report of a stage and its last line.
  std::string stage_, unit_, note_;
  int64_t first_ = 0, done_ = 0, total_ = -1;
  std::chrono::steady_clock::time_point start_, last_print_;
};

/// Counts the units of a stage and reports them to its task. Only Step is thread-safe.
class Progress {
 public:
  /// Reports `done` of `total`: 0, or the units of an earlier session that this one resumes. `unit` is the plural of
  /// what is counted: "faces", "steps".
  Progress(Task task, int64_t total, std::string unit, int64_t done = 0);
  /// On stderr, for a function without a Task.
  Progress(std::string stage, int64_t total, std::string unit);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  /// Reports under a lock, so that counts arrive in order. The last note that is not empty is kept.
  void Step(int64_t count = 1, const std::string& note = "");

 private:
  const Task task_;
  const int64_t total_;
  const std::string unit_;
  std::mutex mutex_;
  int64_t done_;
  std::string note_;
};

/// "sketches: 120/600 faces, 24.0/s, 20 s left": the line of a stage that has run for `seconds` since `first` units
/// were done. When finished, it shows the elapsed time.
std::string ProgressLine(const std::string& stage, int64_t done, int64_t total, const std::string& unit, double seconds,
                         int64_t first = 0);

/// "45 s", "3 min 05 s", "2 h 07 min".
std::string FormatDuration(double seconds);

}  // namespace daumier
