#include "ablation/config.h"

#include "core/files.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::ablation {
namespace {

class AblationConfigTest : public ::testing::Test {
 protected:
  Ablation Load(const std::string& toml, const std::vector<std::string>& overrides = {}) const {
    WriteFileAtomically(folder_ / "base.toml", "epochs = 3\nnetwork.width = 4\nnetwork.hidden = 5\n");
    WriteFileAtomically(folder_ / "table.toml", toml);
    return LoadAblation(folder_ / "table.toml", overrides, {"recover_with"});
  }
  void ExpectRefused(const std::string& toml, const std::string& why) const {
    testing::ExpectError([&] { Load(toml); }, why);
  }

  const testing::TempDir folder_;
};

TEST_F(AblationConfigTest, RowsOverrideTheTableAndTheTableTheBaseAndTheCommandLineAll) {
  const Ablation ablation = Load(R"(
base = "base.toml"
seeds = [4, 5]
splits = ["person", "random"]
[config]
network.hidden = 6
[eval]
strength = 1.0
[[rows]]
name = "a"
paper = 2.04
[[rows]]
name = "b"
config.network.width = 8
config.network.hidden = 7
eval.strength = 2.0
)",
                                 {"epochs=9", "data.faces=here", "seeds=[1]", "eval.side=left"});
  EXPECT_EQ(ablation.options.seeds, std::vector<uint64_t>{1});
  EXPECT_EQ(ablation.options.splits, (std::vector<std::string>{"person", "random"}));
  ASSERT_EQ(ablation.rows.size(), 2u);
  EXPECT_EQ(ablation.rows[0].options.paper, 2.04);
  EXPECT_EQ(ablation.rows[0].config, Json::parse(R"({"epochs": 9, "network": {"width": 4, "hidden": 6},
                                                     "data": {"faces": "here"}})"));
  EXPECT_EQ(ablation.rows[1].config["network"], Json::parse(R"({"width": 8, "hidden": 7})"));
  EXPECT_EQ(ablation.rows[0].eval, Json::parse(R"({"strength": 1.0, "side": "left"})"));
  EXPECT_EQ(ablation.rows[1].eval["strength"], 2.0);
}

TEST_F(AblationConfigTest, RefusesUnknownKeysAndSuggestsTheNearest) {
  ExpectRefused("seed = [1]\n[[rows]]\nname = 'a'\n", "did you mean 'seeds'?");
  ExpectRefused("[[rows]]\nnam = 'a'\n", "did you mean 'name'?");
  ExpectRefused("seeds = [1]\n", "a table needs rows");
  ExpectRefused("[[rows]]\npaper = 1.0\n", "row 1: a row needs a name");
  ExpectRefused("[[rows]]\nname = 'a'\n[[rows]]\nname = 'a'\n", "two rows are named 'a'");
  ExpectRefused("[[rows]]\nname = 'a'\nconfig = 3\n", "expected a table");
  ExpectRefused("seeds = []\n[[rows]]\nname = 'a'\n", "at least one of 'seeds'");
}

TEST_F(AblationConfigTest, RefusesARowThatNeedsOneThatIsNotThere) {
  ExpectRefused("[[rows]]\nname = 'PixelCNN'\n[[rows]]\nname = 'b'\neval.recover_with = 'PixelCN'\n",
                "row 'b': there is no row 'PixelCN'; did you mean 'PixelCNN'?");
  ExpectRefused("[[rows]]\nname = 'a'\n[[rows]]\nname = 'b'\nfrom = 'c'\n", "there is no row 'c'");
  ExpectRefused("compare_to = 'b'\n[[rows]]\nname = 'a'\n", "compare_to: there is no row 'b'");
}

TEST_F(AblationConfigTest, RefusesWordsThatWouldDoNothing) {
  const std::string a = "[[rows]]\nname = 'a'\n";
  ExpectRefused(a + "[[rows]]\nname = 'b'\nfrom = 'a'\neval.strength = 1\n", "it evaluates nothing");
  ExpectRefused(a + "[[rows]]\nname = 'b'\nrun_of = 'a'\nconfig.epochs = 1\n", "it trains nothing");
  ExpectRefused(a + "[[rows]]\nname = 'b'\nrun_of = 'a'\nfrom = 'a'\n", "exclude each other");
  ExpectRefused(a + "[[rows]]\nname = 'b'\nfrom = 'a'\n[[rows]]\nname = 'c'\nfrom = 'b'\n", "no report of its own");
  ExpectRefused("evaluate = false\n" + a + "[[rows]]\nname = 'b'\nrun_of = 'a'\n", "row 'b' trains nothing");
  ExpectRefused(a + "[[rows]]\nname = 'b'\nfrom = 'a'\n[[rows]]\nname = 'c'\nrun_of = 'b'\n", "no run of its own");
}

TEST_F(AblationConfigTest, WhatARowNeedsComesBeforeItAndOthersStayInOrder) {
  const Ablation ablation = Load(
      "[[rows]]\nname = 'shape'\neval.recover_with = 'pixel'\n[[rows]]\nname = 'fit'\nfrom = 'pixel'\n"
      "[[rows]]\nname = 'alone'\n[[rows]]\nname = 'pixel'\neval.recover_with = 'pixel'\n");
  EXPECT_EQ(WorkingOrder(ablation, {"recover_with"}), (std::vector<int>{3, 0, 1, 2}));
  EXPECT_EQ(WorkingOrder(ablation, {"recover_with"}, {"fit"}), (std::vector<int>{3, 1}));
  testing::ExpectError([&] { WorkingOrder(ablation, {}, {"alon"}); }, "did you mean 'alone'?");
  ExpectRefused("[[rows]]\nname = 'a'\neval.recover_with = 'b'\n[[rows]]\nname = 'b'\neval.recover_with = 'a'\n",
                "in a circle: a -> b -> a");
}

TEST(FolderName, IsASafeFolder) {
  EXPECT_EQ(FolderName("PixelCNN-Wrinkle 2.0"), "PixelCNN-Wrinkle-2.0");
  EXPECT_EQ(FolderName("a/b (given)"), "a-b--given-");
  EXPECT_EQ(FolderName(".."), "-.");
}

}  // namespace
}  // namespace daumier::ablation
