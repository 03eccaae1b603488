#include "train/run_log.h"

#include "core/files.h"
#include "core/json.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <sstream>

namespace daumier::train {
namespace {

std::vector<Json> Lines(const std::filesystem::path& run) {
  std::istringstream stream(ReadFile(run / RunLog::kMetricsFile));
  std::vector<Json> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(Json::parse(line));
  return lines;
}

TEST(RunLog, WritesALineAndAnEventAValue) {
  const testing::TempDir run;
  RunLog(run.path(), 0).Write(10, 2, "train", {{"loss", 0.5}, {"learning_rate", 0.001}}, {3.5, 1.5});
  const std::vector<Json> lines = Lines(run.path());
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(
      lines[0].dump(),
      R"({"step":10,"epoch":2,"phase":"train","learning_rate":0.001,"loss":0.5,"seconds":3.5,"session_seconds":1.5})");
  const std::vector<ScalarEvent> events = ReadEvents(run / RunLog::kEventFile);
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[1].tag, "train/loss");
  EXPECT_EQ(events[1].value, 0.5f);
  EXPECT_GT(events[1].wall_time, 1.6e9);
}

TEST(RunLog, DropsWhatIsBeyondTheCheckpointAndALineThatWasCutShort) {
  const testing::TempDir run;
  {
    RunLog log(run.path(), 0);
    for (int step = 10; step <= 40; step += 10) log.Write(step, 1, "train", {{"loss", 1.0 / step}}, {});
  }
  const std::string whole = ReadFile(run / RunLog::kMetricsFile);
  WriteFileAtomically(run / RunLog::kMetricsFile, whole + R"({"step":20,"epo)");
  RunLog(run.path(), 20).Write(25, 1, "validation", {{"error", 3}}, {});
  const std::vector<Json> lines = Lines(run.path());
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[1]["step"], 20);
  EXPECT_EQ(lines[2]["phase"], "validation");
  const std::vector<ScalarEvent> events = ReadEvents(run / RunLog::kEventFile);
  ASSERT_EQ(events.size(), 3u);
  EXPECT_EQ(events[1].step, 20);
  EXPECT_EQ(events[2].tag, "validation/error");
}

std::vector<double> Seconds(const std::filesystem::path& run) {
  std::vector<double> seconds;
  for (const MetricsRecord& record : ReadMetrics(run)) seconds.push_back(record.seconds);
  return seconds;
}

TEST(ReadMetrics, TotalsOfNewRunsAreThoseOfTheirLines) {
  const testing::TempDir run;
  {
    RunLog log(run.path(), 0);
    log.Write(1, 1, "train", {{"loss", 1}}, {5, 5});
    log.Write(2, 1, "train", {{"loss", 1}}, {8, 3});
  }
  WriteFileAtomically(run / RunLog::kMetricsFile, ReadFile(run / RunLog::kMetricsFile) + R"({"step":3,"sec)");
  EXPECT_EQ(Seconds(run.path()), (std::vector<double>{5, 8}));
}

/// An older run, whose seconds restart at 0 on each resume: lines (seconds, wall time of their event).
void WriteOldRun(const std::filesystem::path& run, const std::vector<std::pair<double, double>>& lines, bool events) {
  std::string text;
  std::filesystem::remove(run / RunLog::kEventFile);
  for (size_t i = 0; i < lines.size(); ++i) {
    const int64_t step = int64_t(i) + 1;
    text += Json{{"step", step}, {"phase", "train"}, {"loss", 1}, {"seconds", lines[i].first}}.dump() + "\n";
    if (events) EventWriter(run / RunLog::kEventFile).Write({lines[i].second, step, "train/loss", 1});
  }
  WriteFileAtomically(run / RunLog::kMetricsFile, text);
}

TEST(ReadMetrics, TotalsOfOldRunsAddUpTheirSessions) {
  const testing::TempDir run;
  // Resumed at wall time 1007: 5 | resume | 8.
  WriteOldRun(run.path(), {{5, 1005}, {8, 1015}}, true);
  EXPECT_EQ(Seconds(run.path()), (std::vector<double>{5, 13}));
  // Not resumed.
  WriteOldRun(run.path(), {{5, 1005}, {8, 1008}}, true);
  EXPECT_EQ(Seconds(run.path()), (std::vector<double>{5, 8}));
  // Twice, once with falling seconds.
  WriteOldRun(run.path(), {{5, 1005}, {8, 1015}, {9, 1016}, {2, 1020}}, true);
  EXPECT_EQ(Seconds(run.path()), (std::vector<double>{5, 13, 14, 16}));
  // Without events only falling seconds show a resume.
  WriteOldRun(run.path(), {{5, 0}, {8, 0}, {2, 0}}, false);
  EXPECT_EQ(Seconds(run.path()), (std::vector<double>{5, 8, 10}));
}

TEST(ReadMetrics, AnOldRunThatANewVersionResumesKeepsItsTotal) {
  const testing::TempDir run;
  WriteOldRun(run.path(), {{5, 1005}, {8, 1015}}, true);
  RunLog(run.path(), 2).Write(3, 1, "train", {{"loss", 1}}, {14, 1});
  EXPECT_EQ(Seconds(run.path()), (std::vector<double>{5, 13, 14}));
}

}  // namespace
}  // namespace daumier::train
