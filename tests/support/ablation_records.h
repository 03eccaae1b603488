#pragma once
#include "core/json.h"
#include "reports/ablation_tables.h"
#include "reports/report_table.h"
#include "tests/support/results_pages.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace daumier::testing {

/// The Markdown tables of an ablation, one a split, with a blank line between two.
inline std::string AblationTableText(const Json& table, const std::vector<reports::Metric>& columns) {
  std::string text;
  for (const reports::ReportTable& split : reports::AblationTables(table, columns)) {
    if (!text.empty()) text += "\n";
    text += reports::TableMarkdown(split);
  }
  return text;
}

/// Expects that docs/results holds the tables of each record of docs/results/ablations whose command names a config of
/// that folder, each on a page with the record's command.
inline void ExpectAblationsInResults(const std::string& configs, const std::vector<reports::Metric>& columns) {
  int num_records = 0;
  for (const auto& file : std::filesystem::directory_iterator(ResultsFolder() / "ablations")) {
    const Json record = Json::parse(ReadFile(file.path()));
    const auto command = record.at("command").get<std::string>();
    if (command.find(configs) == std::string::npos) continue;
    ++num_records;
    for (const char* key : {"commit", "seeds", "seconds"})
      EXPECT_TRUE(record.contains(key)) << file.path() << ": " << key;
    ExpectTableInResults("ablations/" + file.path().filename().string(), AblationTableText(record.at("table"), columns),
                         {command});
  }
  EXPECT_GT(num_records, 0);
}

}  // namespace daumier::testing
