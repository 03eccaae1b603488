#include "ablation/ablation.h"

#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"
#include "tests/support/warnings.h"
#include "tests/ablation/fake_ablation.h"

#include <gtest/gtest.h>

namespace daumier::ablation {
namespace {

class AblationTest : public ::testing::Test {
 protected:
  Ablation Load(const std::string& head = "") const {
    WriteFileAtomically(folder_ / "table.toml", head + R"(
[[rows]]
name = "shape"
config.error = 2
eval.recover_with = "pixel"
[[rows]]
name = "pixel"
paper = 2.22
config.error = 3
[[rows]]
name = "fit"
from = "pixel"
line = "fit"
)");
    return LoadAblation(folder_ / "table.toml", {}, task_.references());
  }
  Json Run(const Ablation& ablation, const std::vector<std::string>& only = {}) const {
    return RunAblation(ablation, task_, folder_ / "out", only);
  }
  static std::vector<std::string> Names(const Json& table) {
    std::vector<std::string> names;
    for (const Json& row : table) names.push_back(row["name"].get<std::string>());
    return names;
  }

  const testing::TempDir folder_;
  FakeAblation task_;
};

TEST_F(AblationTest, TrainsWhatIsNeededFirstAndShowsRowsAsTheyAreListed) {
  const Json table = Run(Load());
  EXPECT_EQ(task_.log, (std::vector<std::string>{"train 3", "evaluate 3", "train 2", "evaluate 2"}));
  EXPECT_EQ(Names(table), (std::vector<std::string>{"mean face", "shape", "pixel", "fit"}));
  EXPECT_EQ(Json::parse(ReadFile(folder_ / "out/table.json")), table);
  EXPECT_EQ(table[2]["paper"], 2.22);
  for (const char* file : {"table.md", "curves.svg", "sheet.png", "index.html"})
    EXPECT_TRUE(std::filesystem::exists(folder_ / "out" / file)) << file;
}

TEST_F(AblationTest, ASecondCallDoesNothingAndGivesTheSameTable) {
  const Json first = Run(Load());
  task_.log.clear();
  EXPECT_EQ(Run(Load()), first);
  EXPECT_TRUE(task_.log.empty());
}

TEST_F(AblationTest, FirstSeedHasAllSplitsBeforeTheNextSeedBegins) {
  const auto plan = PlanAblation(Load("seeds = [7, 8]\nsplits = ['person', 'random']\n"), task_, folder_ / "out");
  ASSERT_EQ(plan.size(), 12u);
  std::vector<std::string> order;
  for (size_t i = 0; i < plan.size(); i += 3) order.push_back(fmt::format("{} {}", plan[i].seed, plan[i].split));
  EXPECT_EQ(order, (std::vector<std::string>{"7 person", "7 random", "8 person", "8 random"}));
  EXPECT_EQ(plan[0].row, "pixel");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out")) << "a plan writes nothing";
}

TEST_F(AblationTest, StoppedItGoesOnWhereItWas) {
  task_.end_of_error[2] = "stopped";
  testing::ExpectError([&] { Run(Load()); }, "Go on by the same command again");
  SetInterrupted(false);
  EXPECT_EQ(Names(Json::parse(ReadFile(folder_ / "out/table.json"))),
            (std::vector<std::string>{"mean face", "pixel", "fit"}));
  const auto plan = PlanAblation(Load(), task_, folder_ / "out");
  EXPECT_EQ(plan[0].state, RowState::kDone);
  EXPECT_EQ(plan[1].state, RowState::kToGoOn);
  task_.end_of_error.clear();
  task_.log.clear();
  EXPECT_EQ(Names(Run(Load())), (std::vector<std::string>{"mean face", "shape", "pixel", "fit"}));
  EXPECT_EQ(task_.log, (std::vector<std::string>{"train 2", "evaluate 2"}));
}

TEST_F(AblationTest, OnlyMakesRowsAndWhatTheyNeed) {
  EXPECT_EQ(Names(Run(Load(), {"fit"})), (std::vector<std::string>{"mean face", "pixel", "fit"}));
  EXPECT_EQ(task_.log, (std::vector<std::string>{"train 3", "evaluate 3"}));
}

TEST_F(AblationTest, WithoutEvaluationComparesLeastValidationErrorsAndReadsNoTestFace) {
  WriteFileAtomically(
      folder_ / "trials.toml",
      "evaluate = false\n[[rows]]\nname = 'a'\nconfig.error = 2\n[[rows]]\nname = 'b'\nconfig.error = 3\n");
  const Ablation trials = LoadAblation(folder_ / "trials.toml", {}, {});
  const Json table = Run(trials);
  EXPECT_EQ(task_.log, (std::vector<std::string>{"train 2", "train 3"}));
  EXPECT_EQ(Names(table), (std::vector<std::string>{"a", "b"}));
  EXPECT_DOUBLE_EQ(table[1]["error"].get<double>(), 3 + 1.0 / 10) << "the last of two validations is the least";
  EXPECT_EQ(table[1]["measured_on"], "validation");
  EXPECT_EQ(table[1]["steps"], 10);
  for (const char* key : {"error_low", "difference", "infer_ms"}) EXPECT_TRUE(table[1][key].is_null()) << key;
  EXPECT_NE(ReadFile(folder_ / "out/table.md").find("| validation mm |"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/sheet.png"));
  EXPECT_EQ(Run(trials), table);
  EXPECT_EQ(task_.log.size(), 2u) << "nothing is trained twice";
}

TEST_F(AblationTest, ARowThatFailsStopsThoseAloneThatNeedIt) {
  testing::AllowWarnings();
  task_.end_of_error[3] = "failed";
  const Ablation ablation = Load();
  testing::ExpectError([&] { Run(ablation); }, "shape (person, seed 1): it needs pixel");
  task_.end_of_error = {{2, "failed"}};
  testing::ExpectError([&] { Run(ablation); }, "1 of 3 rows failed");
  EXPECT_EQ(Names(Json::parse(ReadFile(folder_ / "out/table.json"))),
            (std::vector<std::string>{"mean face", "pixel", "fit"}));
}

TEST_F(AblationTest, RefusesRowsThatWereNotMeasuredOnTheSameFaces) {
  Run(Load(), {"pixel"});
  task_.num_faces = 5;
  testing::ExpectError([&] { Run(Load()); }, "were measured on different test faces");
}

TEST_F(AblationTest, RefusesARunOfAnotherConfigBeforeAnythingIsTrained) {
  Ablation ablation = Load();
  Run(ablation, {"shape"});
  task_.log.clear();
  ablation.rows[0].config["error"] = 2.5;
  testing::ExpectError([&] { Run(ablation); }, "is another run");
  EXPECT_TRUE(task_.log.empty());
}

}  // namespace
}  // namespace daumier::ablation
