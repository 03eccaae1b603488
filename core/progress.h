#pragma once
#include <chrono>
#include <cstdint>
#include <string>

namespace daumier {

/// Progress of a long task on stderr with rate and ETA, at most twice a second: one line redrawn on a terminal, plain lines
/// every ten seconds elsewhere. Thread-safe is only Step.
class Progress {
 public:
  /// `unit` is the plural of what is counted: "faces", "steps".
  Progress(std::string label, int64_t total, std::string unit);
  ~Progress();
  void Step(int64_t count = 1, const std::string& note = "");

 private:
  void Print(bool last);

  std::string label_, unit_, note_;
  int64_t total_, done_ = 0;
  std::chrono::steady_clock::time_point start_, last_print_;
};

}  // namespace daumier
