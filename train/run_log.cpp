#include "train/run_log.h"

#include "core/error.h"
#include "core/files.h"
#include "core/json.h"

#include <chrono>
#include <optional>
#include <sstream>
#include <utility>

namespace daumier::train {
namespace {

double WallTime() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

void DropLinesAfter(const std::filesystem::path& file, int64_t last_step) {
  if (!std::filesystem::exists(file)) return;
  std::istringstream lines(ReadFile(file));
  std::string kept, line;
  while (std::getline(lines, line)) {
    const std::optional<Json> entry = TryParseJson(line);
    if (!entry || !entry->contains("step") || entry->at("step").get<int64_t>() > last_step) break;
    kept += line + "\n";
  }
  WriteFileAtomically(file, kept);
}

/// Rewritten through the writer itself: what is kept is what a reader understands.
std::filesystem::path DropEventsAfter(const std::filesystem::path& file, int64_t last_step) {
  if (!std::filesystem::exists(file)) return file;
  std::vector<ScalarEvent> events;
  if (std::filesystem::file_size(file) > 0) events = ReadEvents(file);
  const std::filesystem::path rewritten = file.string() + ".new";
  std::filesystem::remove(rewritten);
  {
    EventWriter writer(rewritten);
    for (const ScalarEvent& event : events)
      if (event.step <= last_step) writer.Write(event);
  }
  std::filesystem::rename(rewritten, file);
  return file;
}

/// Wall times of the events of lines, by step and phase; empty if there is no file.
std::map<std::pair<int64_t, std::string>, double> WallTimes(const std::filesystem::path& file) {
  std::map<std::pair<int64_t, std::string>, double> times;
  if (!std::filesystem::exists(file) || std::filesystem::file_size(file) == 0) return times;
  for (const ScalarEvent& event : ReadEvents(file))
    times[{event.step, event.tag.substr(0, event.tag.find('/'))}] = event.wall_time;
  return times;
}

}  // namespace

RunLog::RunLog(const std::filesystem::path& run_directory, int64_t last_step)
    : metrics_path_(run_directory / kMetricsFile), events_(DropEventsAfter(run_directory / kEventFile, last_step)) {
  DropLinesAfter(metrics_path_, last_step);
  metrics_.open(metrics_path_, std::ios::app);
  DAUMIER_CHECK(metrics_.is_open(), "{} cannot be opened for writing", metrics_path_.string());
}

void RunLog::Write(int64_t step, int64_t epoch, const std::string& phase, const std::map<std::string, double>& values,
                   const TrainingTime& time) {
  Json line = {{"step", step}, {"epoch", epoch}, {"phase", phase}};
  const double wall_time = WallTime();
  for (const auto& [name, value] : values) {
    line[name] = value;
    events_.Write({wall_time, step, phase + "/" + name, float(value)});
  }
  line["seconds"] = time.total;
  line["session_seconds"] = time.session;
  metrics_ << line.dump() << std::endl;
  DAUMIER_CHECK(metrics_.good(), "{} cannot be written: is the disk full?", metrics_path_.string());
}

std::vector<MetricsRecord> ReadMetrics(const std::filesystem::path& run_directory) {
  const auto wall_times = WallTimes(run_directory / RunLog::kEventFile);
  std::vector<MetricsRecord> records;
  std::optional<double> last_wall;
  double last_seconds = 0;
  std::istringstream lines(ReadFile(run_directory / RunLog::kMetricsFile));
  for (std::string text; std::getline(lines, text);) {
    Json line = TryParseJson(text).value_or(Json());
    if (!line.is_object()) continue;
    const double seconds = line.value("seconds", 0.0), total = records.empty() ? 0 : records.back().seconds;
    std::optional<double> wall;
    const auto found = wall_times.find({line.value("step", int64_t{0}), line.value("phase", "")});
    if (found != wall_times.end()) wall = found->second;
    if (line.contains("session_seconds")) {
      records.push_back({std::move(line), seconds});
    } else {
      // Halfway between the clock's start if it is still the same, and the time of the line before.
      const bool started_later = wall && last_wall && *wall - seconds > *last_wall - last_seconds / 2;
      const bool resumed = seconds < last_seconds || started_later;
      records.push_back({std::move(line), total + (resumed ? seconds : seconds - last_seconds)});
    }
    last_wall = wall;
    last_seconds = seconds;
  }
  return records;
}

}  // namespace daumier::train
