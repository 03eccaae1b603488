#pragma once
#include "core/files.h"
#include "reports/ablation_tables.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

namespace daumier::testing {

/// Table and rule lines of a Markdown text.
inline std::vector<std::string> TableLines(const std::string& markdown) {
  std::vector<std::string> lines;
  std::istringstream text(markdown);
  for (std::string line; std::getline(text, line);)
    if (!line.empty() && line.front() == '|') lines.push_back(line);
  return lines;
}

/// Expects that docs/results.md has the command and the tables of each record of docs/results/ablations whose command
/// names a config of that folder.
inline void ExpectAblationsInResults(const std::string& configs, const std::vector<reports::Metric>& columns) {
  const std::string document = ReadFile(SourceRoot() / "docs/results.md");
  int num_records = 0;
  for (const auto& file : std::filesystem::directory_iterator(SourceRoot() / "docs/results/ablations")) {
    const Json record = Json::parse(ReadFile(file.path()));
    for (const char* key : {"command", "commit", "seeds", "seconds", "table"}) EXPECT_TRUE(record.contains(key)) << key;
    const auto command = record.at("command").get<std::string>();
    EXPECT_NE(document.find(command), std::string::npos) << file.path();
    if (command.find(configs) == std::string::npos) continue;
    ++num_records;
    for (const std::string& line : TableLines(reports::AblationMarkdown(record.at("table"), columns)))
      EXPECT_NE(document.find(line), std::string::npos) << file.path() << " and docs/results.md differ: " << line;
  }
  EXPECT_GT(num_records, 0);
}

}  // namespace daumier::testing
