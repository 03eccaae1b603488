#include "rig/expression_map_file.h"

#include "tests/rig/small_expression_map.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::rig {
namespace {

using testing::ExpectError;
using testing::SmallExpressionMap;

TEST(ExpressionMapFile, IsReadAsWritten) {
  const ExpressionMap map = SmallExpressionMap();
  const Json json = ExpressionMapJson(map);
  const ExpressionMap read = ParseExpressionMap(ParseJson(json.dump(), "map.json"), "map.json");
  EXPECT_EQ(read.expressions, map.expressions);
  EXPECT_EQ(read.kind, map.kind);
  EXPECT_EQ(read.constant, map.constant);
  EXPECT_EQ(read.positive, map.positive);
  EXPECT_EQ(read.negative, map.negative);
  EXPECT_EQ(read.model, map.model);
  EXPECT_EQ(read.targets, map.targets);
  ASSERT_EQ(read.mapped.size(), 6u);
  EXPECT_NEAR(read.mapped[0].explained().value(), 0.64, 1e-6);
  EXPECT_EQ(read.mapped[0].gain, 1.5);
  EXPECT_TRUE(read.mapped[4].is_negative);
  EXPECT_EQ(read.mapped[4].name, "b");
}

TEST(ExpressionMapFile, StatesOriginNamesAndErrors) {
  ExpressionMap map = SmallExpressionMap();
  map.mm_per_cm = 12;
  map.mapped = {{"a", false, {0.1, 0.2}, {0.2, 0.5}}, {"a", true, {0, 0}, {0, 0}}};
  const Json json = ExpressionMapJson(map);
  EXPECT_EQ(json["model"]["licence"], "mine");
  EXPECT_EQ(json["names"].size(), 52u);
  EXPECT_EQ(json["names"][0], "eyeBlinkLeft");
  EXPECT_EQ(json["constant"], "mean");
  EXPECT_EQ(json["errors"][0], (Json{{"expression", "a"},
                                     {"coefficient", 1},
                                     {"rms_mm", 1.2},
                                     {"max_mm", 2.4},
                                     {"no_motion_rms_mm", 2.4},
                                     {"no_motion_max_mm", 6.0},
                                     {"explained", 0.75},
                                     {"gain", 1.0}}));
  EXPECT_EQ(json["errors"][1]["coefficient"], -1);
  EXPECT_TRUE(json["errors"][1]["explained"].is_null());
}

TEST(ExpressionMapFile, OfBlendshapesHasOneEnd) {
  ExpressionMap map = SmallExpressionMap();
  map.kind = CoefficientKind::kBlend;
  map.constant = std::nullopt;
  map.negative.resize(0, kNumArkitNames);
  map.mapped.resize(3);
  const Json json = ExpressionMapJson(map);
  EXPECT_FALSE(json.contains("negative"));
  const ExpressionMap read = ParseExpressionMap(json, "map.json");
  EXPECT_EQ(read.negative.rows(), 0);
  EXPECT_FALSE(read.constant);
}

TEST(ExpressionMapFile, RefusesOtherFilesByName) {
  const Json good = ExpressionMapJson(SmallExpressionMap());
  const auto expect = [&](const char* pointer, const Json& value, const char* part) {
    Json bad = good;
    bad[Json::json_pointer(pointer)] = value;
    ExpectError([&] { ParseExpressionMap(bad, "map.json"); }, part);
    ExpectError([&] { ParseExpressionMap(bad, "map.json"); }, "map.json: ");
  };
  ExpectError([] { ParseExpressionMap(Json::array(), "map.json"); }, "map.json: is no map");
  expect("/kind", "faces", "is no map of expressions");
  expect("/format_version", 2, "format version 2, expected 1");
  expect("/names/3", "wink", "not the 52 of ARKit");
  expect("/coefficients", "any", "expected signed or blend");
  expect("/positive/0", Json::array({1, 2}), "row 0 of 'positive' has 2 numbers");
  expect("/positive/0/5", -0.5, "negative or not finite");
  expect("/positive/0/5", "one", "Write it again");
  expect("/negative", Json::array(), "'negative' has 0 rows");
  expect("/errors", Json::array(), "'errors' has 0 rows, expected 6");
  expect("/errors/0/gain", 0.5, "a gain of 0.5, expected 1 to 2.5");
  expect("/expressions", Json::array(), "'expressions' is empty");
  expect("/model", "FLAME", "'model' is no origin");
  expect("/targets/licence", 3, "'targets' is no origin");
  expect("/constant", "c", "'constant' is no expression");
  Json without = good;
  without.erase("model");
  ExpectError([&] { ParseExpressionMap(without, "map.json"); }, "model");
}

}  // namespace
}  // namespace daumier::rig
