#include "ablation/runs.h"

#include "tests/ablation/fake_system.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::ablation {
namespace {

namespace fs = std::filesystem;

AblationRow MakeRow(const std::string& name, double error) {
  AblationRow row;
  row.options.name = name;
  row.config = {{"error", error}};
  return row;
}

class AblationRunsTest : public ::testing::Test {
 protected:
  AblationRunsTest() {
    ablation_.rows = {MakeRow("shape", 2), MakeRow("pixel", 3), MakeRow("again", 0), MakeRow("fit", 0)};
    ablation_.rows[0].eval = {{"recover_with", "pixel"}};
    ablation_.rows[2].options.run_of = "pixel";
    ablation_.rows[2].eval = {{"factor", 2.0}};
    ablation_.rows[3].options.from = "shape";
    ablation_.rows[3].options.line = "fit";
  }
  AblationRuns Runs() const { return {ablation_, FakeSystem::system(), folder_.path()}; }
  AblationRuns::Cell Cell(int row) const { return {ablation_.rows[size_t(row)], "person", 1}; }
  void Make(int row) const {
    FolderCache databases;
    Runs().Train(Cell(row), databases, {});
    Runs().Evaluate(Cell(row), databases, {});
  }

  const testing::TempDir folder_;
  Ablation ablation_;
  const FakeSystem fake_;
};

TEST_F(AblationRunsTest, ARowIsDoneOnceItsReportIsMadeOfItsWeightsAndOptions) {
  EXPECT_EQ(Runs().State(Cell(1)), RowState::kToTrain);
  FolderCache databases;
  Runs().Train(Cell(1), databases, {});
  EXPECT_EQ(Runs().State(Cell(1)), RowState::kToEvaluate);
  Runs().Evaluate(Cell(1), databases, {});
  EXPECT_EQ(Runs().State(Cell(1)), RowState::kDone);
  Make(1);
  EXPECT_EQ(FakeSystem::state().log, (std::vector<std::string>{"train 3", "evaluate 3"})) << "nothing is done twice";

  ablation_.rows[1].eval = {{"factor", 3.0}};
  EXPECT_EQ(Runs().State(Cell(1)), RowState::kToEvaluate);
  ablation_.rows[1].eval = Json::object();
  EXPECT_EQ(Runs().State(Cell(1)), RowState::kDone);
  fs::remove(folder_ / "person/seed1/pixel/report/metrics.json");
  EXPECT_EQ(Runs().State(Cell(1)), RowState::kToEvaluate);
}

TEST_F(AblationRunsTest, AReportIsMadeAgainIfARunThatItNeedsIsAnotherOne) {
  Make(1);
  Make(0);
  EXPECT_EQ(Runs().State(Cell(0)), RowState::kDone);
  fs::remove_all(folder_ / "person/seed1/pixel");
  EXPECT_EQ(Runs().State(Cell(0)), RowState::kToEvaluate);
  ablation_.rows[1].config["error"] = 4;
  Make(1);
  EXPECT_EQ(Runs().State(Cell(0)), RowState::kToEvaluate);
}

TEST_F(AblationRunsTest, RowsWithoutARunOrAReportReadThoseOfOthers) {
  EXPECT_EQ(Runs().State(Cell(2)), RowState::kToTrain);
  Make(1);
  EXPECT_EQ(Runs().State(Cell(2)), RowState::kToEvaluate);
  Make(2);
  EXPECT_EQ(Runs().Run(Cell(2)), Runs().Run(Cell(1)));
  EXPECT_DOUBLE_EQ(Runs().Result(Cell(2)).measure.error, 2 * 3 + 0.01);
  EXPECT_EQ(Runs().Result(Cell(2)).cost->parameters, 7);
  Make(0);
  EXPECT_EQ(Runs().State(Cell(3)), RowState::kDone) << "the report that it is read from exists";
  EXPECT_DOUBLE_EQ(Runs().Result(Cell(3)).measure.error, 5.0);
  EXPECT_FALSE(Runs().Result(Cell(3)).cost.has_value()) << "nothing was trained for it";
  ablation_.rows[3].options.line = "network";
  EXPECT_EQ(Runs().Result(Cell(3)).cost->parameters, 7);
  EXPECT_EQ(Runs().Metrics(Cell(3)), Runs().Metrics(Cell(0)));
  EXPECT_TRUE(Runs().Predictions(Cell(3)).has_value());
  EXPECT_EQ(std::count(FakeSystem::state().log.begin(), FakeSystem::state().log.end(), "train 3"), 1);
}

TEST_F(AblationRunsTest, AReportOfAVersionWithFewerOptionsIsNotMadeAgain) {
  Make(1);
  Make(0);
  for (const char* row : {"pixel", "shape"}) {
    const fs::path file = folder_ / "person/seed1" / row / "measured.json";
    Json measured = Json::parse(ReadFile(file));
    measured["made_of"]["eval"].erase("factor");
    WriteFileAtomically(file, measured.dump());
  }
  EXPECT_EQ(Runs().State(Cell(1)), RowState::kDone);
  EXPECT_EQ(Runs().State(Cell(0)), RowState::kDone);
}

TEST_F(AblationRunsTest, ResultHasTheCostOfTheRun) {
  Make(1);
  const AblationResult result = Runs().Result(Cell(1));
  EXPECT_EQ(result.cost->steps, 10);
  EXPECT_EQ(result.cost->train_seconds, 6.0);
  EXPECT_EQ(result.cost->inference->ms, 2.5);
  EXPECT_GE(result.cost->inference->threads, 1);
  EXPECT_EQ(Runs().Baselines(Cell(1)).front().name, "mean face");
}

TEST_F(AblationRunsTest, RefusesABadConfigBeforeAnythingIsTrainedAndNamesTheRow) {
  ablation_.rows[1].config["eror"] = 1;
  testing::ExpectError([&] { Runs(); }, "config of row 'pixel': unknown key 'eror'; did you mean 'error'?");
  ablation_.rows[1].config.erase("eror");
  ablation_.rows[2].eval["fctor"] = 1;
  testing::ExpectError([&] { Runs(); }, "eval of row 'again': unknown key 'fctor'");
}

TEST(TrainSeconds, AreTotalAcrossResumes) {
  const testing::TempDir folder;
  WriteFileAtomically(folder / "metrics.jsonl",
                      "{\"seconds\": 2.0}\n{\"seconds\": 5.0}\n{\"seconds\": 1.5}\n{\"seconds\": 4.0}\n{\"secon");
  EXPECT_EQ(TrainSeconds(folder.path()), 9.0);
}

TEST(ReadCurve, HoldsTheErrorsOfOnePhaseAndTheSecondsOfTrainingThroughStops) {
  const testing::TempDir folder;
  WriteFileAtomically(folder / "metrics.jsonl",
                      "{\"phase\": \"train\", \"step\": 1, \"mm\": 9, \"seconds\": 2}\n"
                      "{\"phase\": \"validation\", \"step\": 2, \"mm\": 3, \"seconds\": 5}\n"
                      "{\"phase\": \"validation\", \"step\": 3, \"accuracy\": 1, \"seconds\": 6}\n"
                      "{\"phase\": \"validation\", \"step\": 4, \"mm\": 4, \"seconds\": 1}\n");
  const RunCurve curve = ReadCurve(folder.path(), "validation", "mm");
  EXPECT_EQ(curve.steps, (std::vector<double>{2, 4}));
  EXPECT_EQ(curve.errors, (std::vector<double>{3, 4}));
  EXPECT_EQ(curve.seconds, (std::vector<double>{5, 7}));
  EXPECT_EQ(ReadCurve(folder.path(), "train", "mm").errors, std::vector<double>{9});
}

TEST(LeastWithin, IsTheLeastErrorOfAllUntilThen) {
  const RunCurve curve{{1, 2, 3}, {5, 3, 4}, {10, 20, 30}};
  EXPECT_FALSE(LeastWithin(curve, 9).has_value());
  EXPECT_EQ(LeastWithin(curve, 10), 5);
  EXPECT_EQ(LeastWithin(curve, 100), 3);
}

}  // namespace
}  // namespace daumier::ablation
