#include "core/error.h"
#include "core/files.h"
#include "core/json.h"
#include "systems/sketch/metrics.h"
#include "tests/support/ablation_records.h"
#include "tests/support/results_pages.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

namespace daumier::sketch {

namespace {

Json ReadRecord(const std::string& name) {
  return Json::parse(ReadFile(testing::ResultsFolder() / name));
}

std::string DatabaseTable(const Json& databases) {
  std::string text =
      "| database | faces | vertices | seconds | peak MB | components of identities | components of faces |\n"
      "|---|---:|---:|---:|---:|---:|---:|\n";
  for (const Json& row : databases)
    text +=
        fmt::format("| {} | {} | {} | {:.0f} | {} | {} | {} |\n", row.at("name").get<std::string>(),
                    row.at("faces").get<int>(), row.at("vertices").get<int>(), row.at("seconds").get<double>(),
                    row.at("peak_mb").get<int>(), row.at("identities_99").get<int>(), row.at("faces_99").get<int>());
  return text;
}

/// The row of that name of an ablation's record.
Json RowOf(const Json& record, const std::string& name) {
  for (const Json& row : record.at("table"))
    if (row.at("name").get<std::string>() == name) return row;
  throw Error(fmt::format("the record has no row {}", name));
}

/// Millimetres on unseen persons, their interval, millimetres at a random split (mean of two records) and the paper's.
std::string HeadlineCells(const Json& row, const std::optional<double>& at_random) {
  return fmt::format("{:.2f} | {:.2f} to {:.2f} | {} | {} |\n", row.at("error").get<double>(),
                     row.at("error_low").get<double>(), row.at("error_high").get<double>(),
                     at_random ? fmt::format("{:.2f}", *at_random) : "-",
                     row.at("paper").is_null() ? "-" : fmt::format("{:.2f}", row.at("paper").get<double>()));
}

std::string HeadlineTable() {
  const Json persons = ReadRecord("ablations/ict150_person.json");
  const Json at_random[] = {ReadRecord("ablations/ict150_random.json"),
                            ReadRecord("ablations/ict150_random_seed2.json")};
  const Json deform = ReadRecord("ablations/car150_person.json");
  std::string text =
      "| system | predictor | shape input | unseen persons, mm | 95 % interval | random split, mm | paper, mm |\n"
      "|---|---|---|---:|---:|---:|---:|\n";
  for (const char* name : {"mean face", "ridge regression", "PixelShapeCNN", "PixelShapeCNN, recovered", "ShapeNN",
                           "PixelCNN", "PixelCNN-Wrinkle", "Residual"}) {
    const Json row = RowOf(persons, name);
    double sum = 0;
    for (const Json& record : at_random) sum += RowOf(record, name).at("error").get<double>();
    text += fmt::format("| sketch | {} | {} | {}", name, row.at("shape_input").get<std::string>(),
                        HeadlineCells(row, sum / double(std::size(at_random))));
  }
  for (const char* name : {"mean face", "principal components", "hypernetwork", "displacements", "conditioning"})
    text += fmt::format("| deform | {} | - | {}", name, HeadlineCells(RowOf(deform, name), std::nullopt));
  return text;
}

TEST(ResultsDocument, ShowsItsDatabases) {
  const Json databases = ReadRecord("databases/faces.json").at("databases");
  ASSERT_FALSE(databases.empty());
  std::vector<std::string> commands;
  for (const Json& row : databases) {
    commands.push_back(row.at("command").get<std::string>());
    EXPECT_EQ(row.at("data_hash").get<std::string>().size(), 64u);
  }
  testing::ExpectTableInResults("databases/faces.json", DatabaseTable(databases), commands);
}

TEST(ResultsDocument, ShowsTheTablesOfItsRecords) {
  int num_records = 0;
  for (const auto& file : std::filesystem::directory_iterator(testing::ResultsFolder())) {
    if (file.path().extension() != ".json") continue;
    ++num_records;
    const Json record = Json::parse(ReadFile(file.path()));
    for (const char* key : {"command", "commit", "seeds", "train_seconds", "metrics"})
      EXPECT_TRUE(record.contains(key)) << key;
    EXPECT_TRUE(record.at("metrics").contains("data_hash"));
    testing::ExpectTableInResults(file.path().filename().string(),
                                  reports::TableMarkdown(reports::TextTable(ReadSketchMetrics(record.at("metrics")))),
                                  {record.at("command").get<std::string>()});
  }
  EXPECT_GT(num_records, 0);
}

TEST(ResultsDocument, ShowsTheAblationsOfSketchNetworks) {
  testing::ExpectAblationsInResults("configs/sketch/", SketchSummaryColumns());
}

TEST(ResultsDocument, ShowsTheHeadlineOfItsRecords) {
  testing::ExpectTableInResults("headline", HeadlineTable());
}

TEST(ResultsDocument, HasOneTableForEachRecordAndNoOther) {
  std::vector<std::string> expected = {"headline"}, found;
  for (const auto& file : std::filesystem::recursive_directory_iterator(testing::ResultsFolder()))
    if (file.path().extension() == ".json")
      expected.push_back(file.path().lexically_relative(testing::ResultsFolder()).generic_string());
  for (const testing::TableBlock& block : testing::TableBlocks()) found.push_back(block.name);
  std::sort(expected.begin(), expected.end());
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, expected);
}

}  // namespace
}  // namespace daumier::sketch
