#include "core/json.h"

#include "core/files.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier {
namespace {

TEST(Json, KeepsTheOrderOfKeys) {
  EXPECT_EQ(ParseJson(R"({"b": 1, "a": [2, null]})", "text").dump(), R"({"b":1,"a":[2,null]})");
}

TEST(Json, ErrorsNameTheTextAndThePlace) {
  testing::ExpectError([] { ParseJson("{\n  \"a\": ?", "a reply"); }, "a reply: not JSON: ");
  testing::ExpectError([] { ParseJson("{\n  \"a\": ?", "a reply"); }, "line 2, column 8");
}

TEST(Json, OfAFileIsNamedByItsPath) {
  const testing::TempDir folder;
  WriteFileAtomically(folder / "a.json", "[1, 2]");
  EXPECT_EQ(ReadJson(folder / "a.json"), (Json{1, 2}));
  WriteFileAtomically(folder / "a.json", "[1, 2");
  testing::ExpectError([&] { ReadJson(folder / "a.json"); }, (folder / "a.json").string() + ": not JSON");
  testing::ExpectError([&] { ReadJson(folder / "b.json"); }, "b.json");
}

TEST(Json, TryParseIsEmptyWhereTheTextIsNotJson) {
  EXPECT_EQ(TryParseJson("3"), std::optional<Json>(3));
  EXPECT_EQ(TryParseJson("null"), std::optional<Json>(Json()));
  EXPECT_FALSE(TryParseJson("").has_value());
  EXPECT_FALSE(TryParseJson("{\"a\"").has_value());
}

}  // namespace
}  // namespace daumier
