#include "ablation/ablation.h"

#include "tests/ablation/fake_system.h"
#include "tests/support/expect_error.h"
#include "tests/support/warnings.h"

#include <gtest/gtest.h>

#include <new>
#include <stdexcept>

namespace daumier::ablation {
namespace {

class AblationTest : public ::testing::Test {
 protected:
  Ablation LoadText(const std::string& text) const {
    WriteFileAtomically(folder_ / "table.toml", text);
    return LoadAblation(folder_ / "table.toml", {}, FakeSystem::system().system.run_options);
  }
  Ablation Load(const std::string& head = "") const {
    return LoadText(head + R"(
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
  }
  Json Run(const Ablation& ablation, const std::vector<std::string>& only = {}, const Task& task = {}) const {
    return RunAblation(ablation, FakeSystem::system(), folder_ / "out", only, task);
  }
  std::vector<AblationStep> Plan(const Ablation& ablation) const {
    return PlanAblation(ablation, FakeSystem::system(), folder_ / "out");
  }
  static std::vector<std::string> Names(const Json& table) {
    std::vector<std::string> names;
    for (const Json& row : table) names.push_back(row["name"].get<std::string>());
    return names;
  }
  std::vector<std::string> WrittenNames() const { return Names(Json::parse(ReadFile(folder_ / "out/table.json"))); }

  const testing::TempDir folder_;
  const FakeSystem fake_;
  FakeSystem::State& state_ = FakeSystem::state();
};

TEST_F(AblationTest, TrainsWhatIsNeededFirstAndShowsRowsAsTheyAreListed) {
  const Json table = Run(Load());
  EXPECT_EQ(state_.log, (std::vector<std::string>{"train 3", "evaluate 3", "train 2", "evaluate 2"}));
  EXPECT_EQ(Names(table), (std::vector<std::string>{"mean face", "shape", "pixel", "fit"}));
  EXPECT_EQ(Json::parse(ReadFile(folder_ / "out/table.json")), table);
  EXPECT_EQ(table[2]["paper"], 2.22);
  EXPECT_NEAR(table[2]["p90"].get<double>(), 3.11, 1e-9);
  for (const char* file : {"table.md", "curves.svg", "sheet.png", "index.html"})
    EXPECT_TRUE(std::filesystem::exists(folder_ / "out" / file)) << file;
}

TEST_F(AblationTest, TenRowsOpenADatabaseOnce) {
  std::string rows;
  for (int row = 1; row <= 10; ++row) rows += fmt::format("[[rows]]\nname = 'row {0}'\nconfig.error = {0}\n", row);
  EXPECT_EQ(Run(LoadText(rows)).size(), 11u);
  EXPECT_EQ(state_.log.size(), 20u) << "each row is trained and evaluated once";
  EXPECT_EQ(FakeDatabase::num_opened, 1);
}

TEST_F(AblationTest, ASecondCallDoesNothingAndGivesTheSameTable) {
  const Json first = Run(Load());
  state_.log.clear();
  EXPECT_EQ(Run(Load()), first);
  EXPECT_TRUE(state_.log.empty());
}

TEST_F(AblationTest, FirstSeedHasAllSplitsBeforeTheNextSeedBegins) {
  const auto plan = Plan(Load("seeds = [7, 8]\nsplits = ['person', 'random']\n"));
  ASSERT_EQ(plan.size(), 12u);
  std::vector<std::string> order;
  for (size_t i = 0; i < plan.size(); i += 3) order.push_back(fmt::format("{} {}", plan[i].seed, plan[i].split));
  EXPECT_EQ(order, (std::vector<std::string>{"7 person", "7 random", "8 person", "8 random"}));
  EXPECT_EQ(plan[0].row, "pixel");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out")) << "a plan writes nothing";
}

TEST_F(AblationTest, CancelledItResumesWhereItWas) {
  std::stop_source stop;
  state_.end_of_training[2] = [&] {
    stop.request_stop();
    throw Cancelled("a checkpoint is saved");
  };
  testing::ExpectError([&] { Run(Load(), {}, Task(stop.get_token())); }, "The same command resumes it");
  EXPECT_EQ(WrittenNames(), (std::vector<std::string>{"mean face", "pixel", "fit"}));
  EXPECT_EQ(Plan(Load())[0].state, RowState::kDone);
  EXPECT_EQ(Plan(Load())[1].state, RowState::kToResume);
  state_.end_of_training.clear();
  state_.log.clear();
  EXPECT_EQ(Names(Run(Load())), (std::vector<std::string>{"mean face", "shape", "pixel", "fit"}));
  EXPECT_EQ(state_.log, (std::vector<std::string>{"resume 2", "evaluate 2"}));
}

TEST_F(AblationTest, OnlyMakesRowsAndWhatTheyNeed) {
  EXPECT_EQ(Names(Run(Load(), {"fit"})), (std::vector<std::string>{"mean face", "pixel", "fit"}));
  EXPECT_EQ(state_.log, (std::vector<std::string>{"train 3", "evaluate 3"}));
}

TEST_F(AblationTest, OnlyTakesNamesWithCommas) {
  const Ablation ablation = LoadText("[[rows]]\nname = 'pixel, recovered'\nconfig.error = 3\n");
  EXPECT_EQ(Names(Run(ablation, {"pixel, recovered"})), (std::vector<std::string>{"mean face", "pixel, recovered"}));
}

TEST_F(AblationTest, WithoutEvaluationComparesLeastValidationErrorsAndReadsNoTestFace) {
  const Ablation trials =
      LoadText("evaluate = false\n[[rows]]\nname = 'a'\nconfig.error = 2\n[[rows]]\nname = 'b'\nconfig.error = 3\n");
  const Json table = Run(trials);
  EXPECT_EQ(state_.log, (std::vector<std::string>{"train 2", "train 3"}));
  EXPECT_EQ(Names(table), (std::vector<std::string>{"a", "b"}));
  EXPECT_DOUBLE_EQ(table[1]["error"].get<double>(), 3 + 1.0 / 10) << "the last of two validations is the least";
  EXPECT_EQ(table[1]["measured_on"], "validation");
  EXPECT_EQ(table[1]["steps"], 10);
  for (const char* key : {"error_low", "difference", "infer_ms"}) EXPECT_TRUE(table[1][key].is_null()) << key;
  EXPECT_NE(ReadFile(folder_ / "out/table.md").find("| validation mm |"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/sheet.png"));
  EXPECT_EQ(Run(trials), table);
  EXPECT_EQ(state_.log.size(), 2u) << "nothing is trained twice";
}

TEST_F(AblationTest, ARowThatFailsStopsOnlyThoseThatNeedIt) {
  testing::AllowWarnings();
  state_.end_of_training[3] = [] { throw Error("the loss is not a number"); };
  const Ablation ablation = Load();
  testing::ExpectError([&] { Run(ablation); }, "shape (person, seed 1): it needs pixel");
  state_.end_of_training.clear();
  state_.end_of_training[2] = [] { throw Error("the loss is not a number"); };
  testing::ExpectError([&] { Run(ablation); }, "1 of 3 rows failed");
  EXPECT_EQ(WrittenNames(), (std::vector<std::string>{"mean face", "pixel", "fit"}));
}

TEST_F(AblationTest, ARowMayFailByAnyException) {
  testing::AllowWarnings();
  const std::vector<std::function<void()>> failures = {
      [] { throw std::bad_alloc(); }, [] { throw std::out_of_range("map::at"); },
      [] { throw std::runtime_error("CUDA out of memory"); }, [] { Json::object().at("steps").get<int>(); }};
  for (const auto& failure : failures) {
    state_.end_of_training = {{2, failure}};
    testing::ExpectError([&] { Run(Load()); }, "1 of 3 rows failed");
    EXPECT_EQ(WrittenNames(), (std::vector<std::string>{"mean face", "pixel", "fit"}));
    state_.end_of_training.clear();
    state_.end_of_evaluation = {{2, failure}};
    testing::ExpectError([&] { Run(Load()); }, "1 of 3 rows failed");
    state_.end_of_evaluation.clear();
    std::filesystem::remove_all(folder_ / "out");
  }
}

TEST_F(AblationTest, RefusesRowsThatWereNotMeasuredOnTheSameFaces) {
  Run(Load(), {"pixel"});
  state_.num_faces = 5;
  testing::ExpectError([&] { Run(Load()); }, "were measured on different test faces");
}

TEST_F(AblationTest, RefusesARunOfAnotherConfigBeforeAnythingIsTrained) {
  Ablation ablation = Load();
  Run(ablation, {"shape"});
  state_.log.clear();
  ablation.rows[0].config["error"] = 2.5;
  testing::ExpectError([&] { Run(ablation); }, "error is 2.0 there and 2.5 now");
  EXPECT_TRUE(state_.log.empty());
}

}  // namespace
}  // namespace daumier::ablation
