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
  RunLog(run.path(), 0).Write(10, 2, "train", {{"loss", 0.5}, {"learning_rate", 0.001}}, 1.5);
  const std::vector<Json> lines = Lines(run.path());
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].dump(), R"({"step":10,"epoch":2,"phase":"train","learning_rate":0.001,"loss":0.5,"seconds":1.5})");
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
    for (int step = 10; step <= 40; step += 10) log.Write(step, 1, "train", {{"loss", 1.0 / step}}, 0);
  }
  const std::string whole = ReadFile(run / RunLog::kMetricsFile);
  WriteFileAtomically(run / RunLog::kMetricsFile, whole + R"({"step":20,"epo)");
  RunLog(run.path(), 20).Write(25, 1, "validation", {{"error", 3}}, 0);
  const std::vector<Json> lines = Lines(run.path());
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[1]["step"], 20);
  EXPECT_EQ(lines[2]["phase"], "validation");
  const std::vector<ScalarEvent> events = ReadEvents(run / RunLog::kEventFile);
  ASSERT_EQ(events.size(), 3u);
  EXPECT_EQ(events[1].step, 20);
  EXPECT_EQ(events[2].tag, "validation/error");
}

}  // namespace
}  // namespace daumier::train
