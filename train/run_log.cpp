#include "train/run_log.h"

#include "core/error.h"
#include "core/files.h"
#include "core/json.h"

#include <chrono>
#include <sstream>

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
    const Json entry = Json::parse(line, nullptr, /*allow_exceptions=*/false);
    if (entry.is_discarded() || !entry.contains("step") || entry["step"].get<int64_t>() > last_step) break;
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

}  // namespace

RunLog::RunLog(const std::filesystem::path& run_directory, int64_t last_step)
    : metrics_path_(run_directory / kMetricsFile), events_(DropEventsAfter(run_directory / kEventFile, last_step)) {
  DropLinesAfter(metrics_path_, last_step);
  metrics_.open(metrics_path_, std::ios::app);
  DAUMIER_CHECK(metrics_.is_open(), "{} cannot be opened for writing", metrics_path_.string());
}

void RunLog::Write(int64_t step, int64_t epoch, const std::string& phase, const std::map<std::string, double>& values,
                   double seconds) {
  Json line = {{"step", step}, {"epoch", epoch}, {"phase", phase}};
  const double wall_time = WallTime();
  for (const auto& [name, value] : values) {
    line[name] = value;
    events_.Write({wall_time, step, phase + "/" + name, float(value)});
  }
  line["seconds"] = seconds;
  metrics_ << line.dump() << std::endl;
  DAUMIER_CHECK(metrics_.good(), "{} cannot be written: is the disk full?", metrics_path_.string());
}

}  // namespace daumier::train
