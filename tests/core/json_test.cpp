#include "core/json.h"

#include "core/error.h"
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

/// The message of ParseJson(text, "a").
std::string JsonFailure(const std::string& text) {
  try {
    ParseJson(text, "a");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Json, ErrorsHaveThePlaceAndNoCodesOfTheLibrary) {
  EXPECT_EQ(JsonFailure("{\n  \"1e400\": [0,\n  1e400]}"),
            "a: not JSON: line 3, column 3: number overflow parsing '1e400'");
  EXPECT_EQ(JsonFailure("[1, 2e999]"), "a: not JSON: column 5: number overflow parsing '2e999'");
  EXPECT_TRUE(JsonFailure("[1, ?]").starts_with("a: not JSON: column 5: syntax error")) << JsonFailure("[1, ?]");
  EXPECT_LT(JsonFailure('"' + std::string(100'000, 'x')).size(), 400u);
  try {
    Json(3).get<std::string>();
    ADD_FAILURE();
  } catch (const Json::exception& error) {
    EXPECT_EQ(TextOf(error), "type must be string, but is number");
  }
}

TEST(Json, NestingIsBounded) {
  const auto nested = [](int depth) { return std::string(depth, '[') + std::string(depth, ']'); };
  EXPECT_NO_THROW(ParseJson(nested(200), "a"));
  EXPECT_EQ(JsonFailure(nested(201)), "a: not JSON: column 201: values are nested more than 200 deep");
  EXPECT_EQ(JsonFailure(std::string(300, '[')), "a: not JSON: column 201: values are nested more than 200 deep");
  EXPECT_FALSE(TryParseJson(nested(201)).has_value());
  EXPECT_EQ(ParseJson("\"\\\"" + std::string(300, '[') + '"', "a").get<std::string>().size(), 301u) << "text";
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
