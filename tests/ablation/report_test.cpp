#include "ablation/report.h"

#include "tests/ablation/fake_system.h"

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
  AblationRuns Runs() const { return {ablation_, FakeSystem::system(), folder_.path()}; }
  void Make(size_t row, const std::string& split) const {
    FolderCache databases;
    Runs().Train({ablation_.rows[row], split, 1}, databases, {});
    Runs().Evaluate({ablation_.rows[row], split, 1}, databases, {});
  }
  Json Write(RowSheet row_sheet = RowSheet::kDraw) const {
    return WriteAblationReport(ablation_, Runs(), FakeSystem::system(), folder_.path(), row_sheet);
  }
  std::string Text(const char* file) const { return ReadFile(folder_ / file); }
  render::Image Sheet() const { return render::ReadImage(folder_ / "sheet.png"); }

  const testing::TempDir folder_;
  const FakeSystem fake_;
  Ablation ablation_;
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
}

TEST_F(AblationReportTest, DrawsTheSheetOfTheFirstSplitFromTheReports) {
  Make(0, "person");
  Write();
  const render::Image one = Sheet();
  Make(1, "person");
  Make(0, "random");
  Write(RowSheet::kKeep);
  EXPECT_EQ(Sheet(), one) << "it is not drawn again";
  std::filesystem::remove_all(folder_ / "person/seed1/row-2/run/best");
  Write();
  const render::Image two = Sheet();
  EXPECT_GT(two.width, one.width) << "a column a row";
  EXPECT_EQ(two.height, one.height);
}

TEST_F(AblationReportTest, RowsWithoutPredictionsAreNotInTheSheet) {
  Make(0, "person");
  Write();
  const render::Image one = Sheet();
  FakeSystem::state().keep_predictions = false;
  Make(1, "person");
  EXPECT_EQ(Write().size(), 3u);
  EXPECT_EQ(Sheet(), one);
}

TEST_F(AblationReportTest, ShowsCurvesOfBothSplits) {
  for (const size_t row : {0, 1})
    for (const char* split : {"person", "random"}) Make(row, split);
  EXPECT_EQ(Write().size(), 6u);
  const std::string curves = Text("curves.svg"), page = Text("index.html");
  EXPECT_NE(curves.find("Split: random"), std::string::npos);
  EXPECT_NE(curves.find("2.10  row 2"), std::string::npos) << "the least validation error of that row";
  for (const char* part : {"sheet.png", "curves.svg", "Split: person", "row 3"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
}

TEST_F(AblationReportTest, HasTheValidationErrorWithinTheTimeOfTheShortestTraining) {
  for (const size_t row : {0, 1}) Make(row, "person");
  // The second row took longer, and became better only then.
  const AblationRuns runs = Runs();
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
