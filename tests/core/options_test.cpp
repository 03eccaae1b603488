#include "core/options.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace daumier {
namespace {

struct InnerOptions {
  double gamma = 0.2;
  std::vector<int> sizes = {3, 5};
  template <class V>
  void Visit(V&& visit) {
    visit("gamma", gamma, Range{0.0, 0.8}, "Exponent | of curvature.");
    visit("sizes", sizes, Range{1, 9}, "Sizes.");
  }
};

struct OuterOptions {
  bool fast = false;
  int count = 10;
  int64_t steps = -5;
  uint64_t seed = 7;
  std::string view = "front";
  std::string name = "a";
  std::vector<double> levels = {0.0, 0.1};
  std::vector<std::string> tags = {"x"};
  InnerOptions exaggeration;
  template <class V>
  void Visit(V&& visit) {
    visit("fast", fast, Flag{}, "Whether to hurry.");
    visit("count", count, Range{1, 100}, "How many.");
    visit("steps", steps, Range{-1e18, 1e18}, "Steps.");
    visit("seed", seed, Range{0, 1e18}, "Seed.");
    visit("view", view, Choices{{"front", "side"}}, "View.");
    visit("name", name, Text{}, "Name.");
    visit("levels", levels, Range{0, 1}, "Levels.");
    visit("tags", tags, Text{}, "Tags.");
    visit("exaggeration", exaggeration, Table{}, "How faces are exaggerated.");
  }
};

OuterOptions Parse(const char* json) {
  return ParseOptions<OuterOptions>(Json::parse(json), "test.toml");
}

std::string WholeFailure(const char* json) {
  try {
    Parse(json);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "no error";
}

/// Without the help of the option.
std::string ParseFailure(const char* json) {
  const std::string failure = WholeFailure(json);
  return failure.substr(0, failure.find('\n'));
}

TEST(Options, AbsentFieldsKeepTheirDefaults) {
  const OuterOptions options = Parse("{}");
  EXPECT_EQ(options.count, 10);
  EXPECT_EQ(options.exaggeration.gamma, 0.2);
}

TEST(Options, EveryTypeIsRead) {
  const OuterOptions options =
      Parse(R"({"fast": true, "count": 3, "steps": -8, "seed": 9, "view": "side", "name": "b c",
      "levels": [1, 0.5], "tags": ["p", "q"], "exaggeration": {"gamma": 0.5, "sizes": []}})");
  EXPECT_TRUE(options.fast);
  EXPECT_EQ(options.count, 3);
  EXPECT_EQ(options.steps, -8);
  EXPECT_EQ(options.seed, 9u);
  EXPECT_EQ(options.view, "side");
  EXPECT_EQ(options.name, "b c");
  EXPECT_EQ(options.levels, (std::vector<double>{1, 0.5}));
  EXPECT_EQ(options.tags, (std::vector<std::string>{"p", "q"}));
  EXPECT_EQ(options.exaggeration.gamma, 0.5);
  EXPECT_TRUE(options.exaggeration.sizes.empty());
}

TEST(Options, ParseUndoesToJson) {
  OuterOptions options;
  options.seed = 12345678901234567;
  options.exaggeration.gamma = 0.1 + 0.2;
  options.tags = {"a\"b", ""};
  const Json json = ToJson(options);
  EXPECT_EQ(json.size(), 9u);
  EXPECT_EQ(ToJson(ParseOptions<OuterOptions>(json)), json);
  EXPECT_EQ(json["exaggeration"]["gamma"], 0.1 + 0.2);
}

TEST(Options, UnknownKeySuggestsTheNearest) {
  EXPECT_EQ(ParseFailure(R"({"cuont": 3})"), "test.toml: unknown key 'cuont'; did you mean 'count'?");
  EXPECT_EQ(ParseFailure(R"({"exaggeration": {"gama": 3}})"),
            "test.toml: unknown key 'exaggeration.gama'; did you mean 'exaggeration.gamma'?");
}

TEST(Options, KeyOfAnotherTableIsSuggested) {
  EXPECT_EQ(ParseFailure(R"({"gamma": 0.3})"), "test.toml: unknown key 'gamma'; did you mean 'exaggeration.gamma'?");
  EXPECT_EQ(ParseFailure(R"({"gammma": 0.3})"), "test.toml: unknown key 'gammma'; did you mean 'exaggeration.gamma'?");
}

TEST(Options, UnknownKeyFarFromAllListsThemAll) {
  const std::string message = ParseFailure(R"({"zzzzzzzz": 3})");
  EXPECT_NE(message.find("known are: count, exaggeration.gamma"), std::string::npos) << message;
}

TEST(Options, WrongTypeIsRefused) {
  EXPECT_EQ(ParseFailure(R"({"count": 2.5})"), "test.toml: 'count' is 2.5, expected an integer");
  EXPECT_EQ(ParseFailure(R"({"count": "3"})"), "test.toml: 'count' is \"3\", expected an integer");
  EXPECT_EQ(ParseFailure(R"({"seed": -1})"), "test.toml: 'seed' is -1, expected an integer");
  EXPECT_EQ(ParseFailure(R"({"count": 5000000000})"), "test.toml: 'count' is 5000000000, expected an integer");
  EXPECT_EQ(ParseFailure(R"({"fast": 1})"), "test.toml: 'fast' is 1, expected true or false");
  EXPECT_EQ(ParseFailure(R"({"levels": 0.5})"), "test.toml: 'levels' is 0.5, expected a list");
  EXPECT_EQ(ParseFailure(R"({"levels": [0.5, "x"]})"), "test.toml: 'levels[1]' is \"x\", expected a number");
  EXPECT_EQ(ParseFailure(R"({"name": 4})"), "test.toml: 'name' is 4, expected a text");
  EXPECT_EQ(ParseFailure(R"({"exaggeration": 4})"), "test.toml: 'exaggeration' is 4, expected a table");
  EXPECT_EQ(ParseFailure("[]"), "test.toml: '(top level)' is [], expected a table");
}

TEST(Options, ValueOutOfRangeIsRefused) {
  EXPECT_EQ(ParseFailure(R"({"count": 101})"), "test.toml: 'count' is 101, expected 1 to 100");
  EXPECT_EQ(ParseFailure(R"({"exaggeration": {"gamma": -0.1}})"),
            "test.toml: 'exaggeration.gamma' is -0.1, expected 0 to 0.8");
  EXPECT_EQ(ParseFailure(R"({"exaggeration": {"sizes": [1, 10]}})"),
            "test.toml: 'exaggeration.sizes[1]' is 10, expected 1 to 9");
  EXPECT_EQ(ParseFailure(R"({"view": "frnt"})"),
            "test.toml: 'view' is 'frnt', expected one of: front, side; did you mean 'front'?");
}

TEST(Options, RangeIsClosedAndHoldsNoNan) {
  EXPECT_EQ(Parse(R"({"count": 100})").count, 100);
  EXPECT_EQ(Parse(R"({"count": 1})").count, 1);
  Json json;
  json["exaggeration"]["gamma"] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(ParseOptions<OuterOptions>(json), UsageError);
}

TEST(Options, HelpHasOneLineAField) {
  const std::string help = HelpText<OuterOptions>();
  EXPECT_EQ(std::count(help.begin(), help.end(), '\n'), 10);
  EXPECT_NE(help.find("  exaggeration.gamma = 0.2    Exponent | of curvature. (0 to 0.8)\n"), std::string::npos)
      << help;
  EXPECT_NE(help.find("view = \"front\""), std::string::npos) << help;
  EXPECT_NE(help.find("(one of: front, side)"), std::string::npos) << help;
}

TEST(Options, AWrongValueShowsTheHelpOfItsOptionAlone) {
  EXPECT_EQ(WholeFailure(R"({"exaggeration": {"gamma": 2}})"),
            "test.toml: 'exaggeration.gamma' is 2, expected 0 to 0.8\n"
            "  exaggeration.gamma = 0.2  Exponent | of curvature. (0 to 0.8)");
  EXPECT_EQ(WholeFailure(R"({"levels": [0.5, 3]})"),
            "test.toml: 'levels[1]' is 3, expected 0 to 1\n  levels = [0.0,0.1]  Levels. (0 to 1)");
  EXPECT_EQ(WholeFailure(R"({"exaggeration": 4})"), "test.toml: 'exaggeration' is 4, expected a table");
}

TEST(NearestWord, IsTheOneWithFewestEdits) {
  const std::set<std::string> known = {"gamma", "learning_rate", "momentum"};
  EXPECT_EQ(NearestWord("gama", known), "gamma");
  EXPECT_EQ(NearestWord("learningrate", known), "learning_rate");
  EXPECT_EQ(NearestWord("gamma", known), "gamma");
}

TEST(NearestWord, IsEmptyWhereNoneIsNear) {
  EXPECT_EQ(NearestWord("epochs", {"gamma", "momentum"}), "");
  EXPECT_EQ(NearestWord("x", {}), "");
}

}  // namespace
}  // namespace daumier
