#include "core/files.h"
#include "core/json.h"
#include "tests/support/paths.h"
#include "ablation/table.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

namespace daumier::ablation {
namespace {

/// Table and rule lines of a Markdown text, without what stands between them.
std::vector<std::string> TableLines(const std::string& markdown) {
  std::vector<std::string> lines;
  std::istringstream text(markdown);
  for (std::string line; std::getline(text, line);)
    if (!line.empty() && line.front() == '|') lines.push_back(line);
  return lines;
}

TEST(ResultsDocument, ShowsTheAblationsOfItsRecords) {
  const std::string document = ReadFile(testing::SourceRoot() / "docs/results.md");
  int num_records = 0;
  for (const auto& file : std::filesystem::directory_iterator(testing::SourceRoot() / "docs/results/ablations")) {
    ++num_records;
    const Json record = Json::parse(ReadFile(file.path()));
    for (const char* key : {"command", "commit", "seeds", "seconds", "table"}) EXPECT_TRUE(record.contains(key)) << key;
    EXPECT_NE(document.find(record.at("command").get<std::string>()), std::string::npos) << file.path();
    for (const std::string& line : TableLines(AblationMarkdown(record.at("table"))))
      EXPECT_NE(document.find(line), std::string::npos) << file.path() << " and docs/results.md do not agree: " << line;
  }
  EXPECT_GT(num_records, 0);
}

}  // namespace
}  // namespace daumier::ablation
