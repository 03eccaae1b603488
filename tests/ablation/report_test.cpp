#include "ablation/report.h"

#include "tests/support/temp_dir.h"
#include "tests/ablation/fake_ablation.h"

#include <gtest/gtest.h>

namespace daumier::ablation {
namespace {

class AblationReportTest : public ::testing::Test {
 protected:
  AblationReportTest() {
    ablation_.options.splits = {"person", "random"};
    for (const double error : {2.0, 3.0}) {
      AblationRow& row = ablation_.rows.emplace_back();
      row.options.name = fmt::format("row {}", error);
      row.config = {{"error", error}};
    }
  }
  void Make(size_t row, const std::string& split) const {
    const AblationRuns runs(ablation_, task_, folder_.path());
    runs.Train({ablation_.rows[row], split, 1});
    runs.Evaluate({ablation_.rows[row], split, 1});
  }
  Json Write() const {
    return WriteAblationReport(ablation_, task_, AblationRuns(ablation_, task_, folder_.path()), folder_.path());
  }
  std::string Text(const char* file) const { return ReadFile(folder_ / file); }

  const testing::TempDir folder_;
  Ablation ablation_;
  FakeAblation task_;
};

TEST_F(AblationReportTest, WithoutARowIsEmpty) {
  EXPECT_EQ(Write(), Json::array());
  EXPECT_EQ(Text("index.html").find("<img"), std::string::npos);
}

TEST_F(AblationReportTest, LeavesOutWhatIsNotDone) {
  Make(1, "person");
  const Json table = Write();
  ASSERT_EQ(table.size(), 2u);
  EXPECT_EQ(table[0]["name"], "mean face");
  EXPECT_EQ(table[1]["name"], "row 3");
  EXPECT_EQ(Text("sheet.png"), "row 3\n");
}

TEST_F(AblationReportTest, ShowsASheetOfTheFirstSplitAndCurvesOfBoth) {
  for (const size_t row : {0, 1})
    for (const char* split : {"person", "random"}) Make(row, split);
  EXPECT_EQ(Write().size(), 6u);
  EXPECT_EQ(Text("sheet.png"), "row 2\nrow 3\n");
  WriteAblationReport(ablation_, task_, AblationRuns(ablation_, task_, folder_.path()), folder_.path(), false);
  EXPECT_EQ(task_.num_sheets, 1) << "it stays as it is";
  const std::string curves = Text("curves.svg"), page = Text("index.html");
  EXPECT_NE(curves.find("Split: random"), std::string::npos);
  EXPECT_NE(curves.find("2.10  row 2"), std::string::npos) << "the least validation error of that row";
  for (const char* part : {"sheet.png", "curves.svg", "Split: person", "row 3"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
}

TEST_F(AblationReportTest, TellsValidationWithinTheTimeOfTheShortestTraining) {
  for (const size_t row : {0, 1}) Make(row, "person");
  // The second row took longer, and became better only then.
  const AblationRuns runs(ablation_, task_, folder_.path());
  const auto line = [](int step, double error, double seconds) {
    return Json{{"phase", "validation"}, {"step", step}, {"error", error}, {"seconds", seconds}}.dump() + "\n";
  };
  WriteFileAtomically(runs.Run({ablation_.rows[0], "person", 1}) / "metrics.jsonl", line(1, 4, 5) + line(2, 3, 10));
  WriteFileAtomically(runs.Run({ablation_.rows[1], "person", 1}) / "metrics.jsonl", line(1, 6, 9) + line(2, 1, 30));
  const Json table = Write();
  EXPECT_EQ(table[1]["equal_seconds"], 10);
  EXPECT_EQ(table[1]["validation_at_equal_time"], 3);
  EXPECT_EQ(table[2]["validation_at_equal_time"], 6);
}

}  // namespace
}  // namespace daumier::ablation
