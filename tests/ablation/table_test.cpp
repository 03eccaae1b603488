#include "ablation/table.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::ablation {
namespace {

AblationResult MakeResult(const std::string& name, uint64_t seed, const std::vector<double>& face_errors) {
  AblationResult result{.name = name, .split = "person", .seed = seed};
  result.measure.error = Mean(face_errors);
  result.measure.interval = Interval{result.measure.error - 1, result.measure.error + 1};
  result.measure.face_errors = face_errors;
  for (size_t face = 0; face < face_errors.size(); ++face) result.measure.groups.push_back(int(face));
  result.measure.more = {{"p90", 2.0 * double(seed)}, {"shape_input", "none"}, {"regions", {{"nose", double(seed)}}}};
  result.cost = RunCost{.steps = 10, .parameters = 7, .train_seconds = 3, .inference = RunCost::Inference{2, 1}};
  return result;
}

TEST(AblationTable, OfOneSeedHasTheAgreedKeysAndTheReportsOwnInterval) {
  AblationResult result = MakeResult("a", 1, {1, 3});
  result.paper = 2.04;
  const Json table = AblationTableJson({result});
  ASSERT_EQ(table.size(), 1u);
  const Json& row = table[0];
  for (const char* key : {"name", "split", "paper", "error", "error_low", "error_high", "seeds", "steps", "parameters",
                          "train_seconds", "infer_ms", "infer_threads", "p90", "shape_input", "difference"})
    EXPECT_TRUE(row.contains(key)) << key;
  EXPECT_EQ(row["paper"], 2.04);
  EXPECT_EQ(row["error"], 2.0);
  EXPECT_EQ(row["error_low"], 1.0);
  EXPECT_EQ(row["error_high"], 3.0);
  EXPECT_EQ(row["seeds"], Json::array({1}));
  EXPECT_EQ(row["steps"], 10);
  EXPECT_TRUE(row["difference"].is_null()) << "the first row differs from itself in nothing";
}

TEST(AblationTable, OfSeveralSeedsIsTheirMeanAndKeepsEachOne) {
  const Json table = AblationTableJson({MakeResult("a", 1, {1, 3}), MakeResult("a", 2, {5, 7})});
  ASSERT_EQ(table.size(), 1u);
  EXPECT_EQ(table[0]["error"], 4.0);
  EXPECT_EQ(table[0]["errors"], Json::array({2.0, 6.0}));
  EXPECT_EQ(table[0]["p90"], 3.0);
  EXPECT_EQ(table[0]["regions"]["nose"], 1.5);
  EXPECT_EQ(table[0]["shape_input"], "none");
  // Person 0 has 1 and 5, person 1 has 3 and 7: whoever is drawn, the mean lies between 3 and 5.
  EXPECT_EQ(table[0]["error_low"], 3.0);
  EXPECT_EQ(table[0]["error_high"], 5.0);
}

TEST(AblationTable, DifferencesArePairedFaceByFace) {
  // Errors of faces differ much, those of the rows always by 0.5: the interval of the difference has no width.
  const Json table = AblationTableJson({MakeResult("a", 1, {1, 9, 4}), MakeResult("b", 1, {1.5, 9.5, 4.5})});
  EXPECT_EQ(table[1]["difference_to"], "a");
  EXPECT_DOUBLE_EQ(table[1]["difference"].get<double>(), 0.5);
  EXPECT_DOUBLE_EQ(table[1]["difference_low"].get<double>(), 0.5);
  EXPECT_DOUBLE_EQ(table[1]["difference_high"].get<double>(), 0.5);
  testing::ExpectError(
      [] {
        AblationTableJson({MakeResult("a", 1, {1, 9}), MakeResult("b", 1, {1})});
      },
      "they cannot be compared");
}

TEST(AblationTable, DifferencesAreToTheRowThatIsNamedBaselinesIncluded) {
  AblationResult mean_face = MakeResult("mean face", 1, {8, 9});
  mean_face.baseline = true;
  const std::vector<AblationResult> results = {MakeResult("a", 1, {1, 3}), mean_face, MakeResult("b", 1, {2, 5})};
  const Json table = AblationTableJson(results, "b");
  EXPECT_EQ(table[0]["difference"], 5.0) << "of the mean face";
  EXPECT_EQ(table[1]["difference"], -1.5);
  EXPECT_TRUE(table[2]["difference"].is_null());
  EXPECT_EQ(table[1]["difference_to"], "b");
  EXPECT_TRUE(AblationTableJson(results, "not done yet")[1]["difference"].is_null());
}

TEST(AblationTable, WhatIsUnknownIsNull) {
  AblationResult fit = MakeResult("fit", 1, {1, 3});
  fit.cost.reset();
  fit.measure.face_errors.clear();
  const Json table = AblationTableJson({MakeResult("a", 1, {1, 3}), fit});
  for (const char* key : {"paper", "difference", "difference_low", "steps", "parameters", "train_seconds", "infer_ms"})
    EXPECT_TRUE(table[1].at(key).is_null()) << key;
  EXPECT_EQ(AblationTableJson({fit, MakeResult("a", 1, {1, 3}), MakeResult("b", 1, {1, 3})})[2]["difference_to"], "a")
      << "the first row that has face errors";
  AblationResult second = fit;
  second.seed = 2;
  EXPECT_TRUE(AblationTableJson({fit, second})[0]["error_low"].is_null());
}

TEST(AblationTable, BaselinesPrecedeTheRowsOfTheirSplitAndSplitsFollowEachOther) {
  AblationResult mean_face = MakeResult("mean face", 1, {8, 9}), random = MakeResult("a", 1, {1, 2});
  mean_face.baseline = true;
  random.split = "random";
  const Json table = AblationTableJson({MakeResult("a", 1, {1, 3}), mean_face, MakeResult("b", 1, {2, 3}), random});
  std::vector<std::string> names;
  for (const Json& row : table) names.push_back(row["split"].get<std::string>() + " " + row["name"].get<std::string>());
  EXPECT_EQ(names, (std::vector<std::string>{"person mean face", "person a", "person b", "random a"}));
}

}  // namespace
}  // namespace daumier::ablation
