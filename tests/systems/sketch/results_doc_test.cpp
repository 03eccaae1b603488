#include "core/files.h"
#include "core/json.h"
#include "systems/sketch/metrics.h"
#include "tests/support/paths.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace daumier::sketch {

namespace {

/// A line of the table of databases.
std::string DatabaseLine(const Json& row) {
  return fmt::format("| {} | {} | {} | {:.0f} | {} | {} | {} |\n", row.at("name").get<std::string>(),
                     row.at("faces").get<int>(), row.at("vertices").get<int>(), row.at("seconds").get<double>(),
                     row.at("peak_mb").get<int>(), row.at("identities_99").get<int>(), row.at("faces_99").get<int>());
}

TEST(ResultsDocument, ShowsItsDatabases) {
  const std::string document = ReadFile(testing::SourceRoot() / "docs/results.md");
  const Json record = Json::parse(ReadFile(testing::SourceRoot() / "docs/results/databases/faces.json"));
  ASSERT_FALSE(record.at("databases").empty());
  for (const Json& row : record.at("databases")) {
    EXPECT_NE(document.find(DatabaseLine(row)), std::string::npos) << DatabaseLine(row);
    EXPECT_NE(document.find(row.at("command").get<std::string>()), std::string::npos) << row.at("command");
    EXPECT_EQ(row.at("data_hash").get<std::string>().size(), 64u);
  }
}

TEST(ResultsDocument, ShowsTheTablesOfItsRecords) {
  const std::string document = ReadFile(testing::SourceRoot() / "docs/results.md");
  int num_records = 0;
  for (const auto& file : std::filesystem::directory_iterator(testing::SourceRoot() / "docs/results")) {
    if (file.path().extension() != ".json") continue;
    ++num_records;
    const Json record = Json::parse(ReadFile(file.path()));
    for (const char* key : {"command", "commit", "seeds", "train_seconds", "metrics"})
      EXPECT_TRUE(record.contains(key)) << key;
    EXPECT_TRUE(record.at("metrics").contains("data_hash"));
    EXPECT_NE(document.find(reports::TableMarkdown(reports::TextTable(ReadSketchMetrics(record.at("metrics"))))), std::string::npos)
        << file.path() << " and docs/results.md do not agree";
    EXPECT_NE(document.find(record.at("command").get<std::string>()), std::string::npos) << file.path();
  }
  EXPECT_GT(num_records, 0);
}

}  // namespace
}  // namespace daumier::sketch
