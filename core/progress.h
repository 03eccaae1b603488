#pragma once
#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

namespace daumier {

/// Progress of a long task on stderr with rate and ETA, at most twice a second: one line redrawn on a terminal, plain
/// lines every ten seconds elsewhere. Silent where the log's level is above kInfo. Thread-safe is only Step.
class Progress {
 public:
  /// `unit` is the plural of what is counted: "faces", "steps".
  Progress(std::string label, int64_t total, std::string unit);
  /// Prints the last line: how many, how long, how fast.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void Step(int64_t count = 1, const std::string& note = "");

 private:
  void Print(bool last);

  std::string label_, unit_, note_;
  int64_t total_, done_ = 0;
  std::mutex mutex_;
  bool terminal_;
  std::chrono::steady_clock::time_point start_, last_print_;
};

/// "sketches: 120/600 faces, 24.0/s, 20 s left": the line of a task that has run for `seconds`. A finished one tells
/// its time.
std::string ProgressLine(const std::string& label, int64_t done, int64_t total, const std::string& unit,
                         double seconds);

/// "45 s", "3 min 05 s", "2 h 07 min".
std::string FormatDuration(double seconds);

}  // namespace daumier
