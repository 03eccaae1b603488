#pragma once
#include "train/event_file.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

namespace daumier::train {

/// The numbers of a running training, twice: metrics.jsonl (an object a line: step, epoch, phase, the values, seconds)
/// and a TensorBoard event file (tags phase/name). Only `seconds` and the events' wall times hold a clock, so that the
/// rest of a resumed run's lines equals an uninterrupted run's.
class RunLog {
 public:
  static constexpr const char* kMetricsFile = "metrics.jsonl";
  static constexpr const char* kEventFile = "events.out.tfevents.daumier";

  /// Opens both files in the run folder, starting them if they are missing. What was written after `last_step`, the
  /// step of the checkpoint that training goes on from, is dropped, and so is a line that a kill cut short.
  RunLog(const std::filesystem::path& run_directory, int64_t last_step);

  /// phase: "train" or "validation"; seconds: since training began or went on. Written through at once.
  void Write(int64_t step, int64_t epoch, const std::string& phase, const std::map<std::string, double>& values,
             double seconds);

 private:
  std::filesystem::path metrics_path_;
  std::ofstream metrics_;
  EventWriter events_;
};

}  // namespace daumier::train
