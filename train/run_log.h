#pragma once
#include "core/json.h"
#include "train/event_file.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace daumier::train {

/// How long a run has been trained, in seconds.
struct TrainingTime {
  double total = 0;    ///< Across resumes.
  double session = 0;  ///< Since training began or resumed.
};

/// The numbers of a running training, twice: metrics.jsonl (an object a line: step, epoch, phase, the values, seconds,
/// session_seconds) and a TensorBoard event file (tags phase/name). Only the seconds and the events' wall times hold a
/// clock, so that the rest of a resumed run's lines equals an uninterrupted run's.
class RunLog {
 public:
  static constexpr const char* kMetricsFile = "metrics.jsonl";
  static constexpr const char* kEventFile = "events.out.tfevents.daumier";

  /// Opens both files in the run folder, starting them if they are missing. What was written after `last_step`, the
  /// step of the checkpoint that training resumes from, is dropped; an incomplete last line is too.
  RunLog(const std::filesystem::path& run_directory, int64_t last_step);

  /// phase: "train" or "validation". Written through at once.
  void Write(int64_t step, int64_t epoch, const std::string& phase, const std::map<std::string, double>& values,
             const TrainingTime& time);

 private:
  std::filesystem::path metrics_path_;
  std::ofstream metrics_;
  EventWriter events_;
};

/// A line of metrics.jsonl.
struct MetricsRecord {
  Json line;
  double seconds = 0;  ///< Training time until it was written, across resumes.
};

/// Every whole line of metrics.jsonl; an incomplete last line is skipped. `seconds` of a line is the total where
/// it has session_seconds. Lines of older runs count from the last resume: a resume lies between two of them where the
/// clock of the second, its event's wall time less its seconds, starts after the first was written, or, without events,
/// where the seconds fall. @throws Error if there is no metrics.jsonl.
std::vector<MetricsRecord> ReadMetrics(const std::filesystem::path& run_directory);

}  // namespace daumier::train
