#include "core/config.h"

#include "core/error.h"
#include "core/files.h"
#include "core/random.h"
#include "tests/support/corruption.h"
#include "tests/support/temp_dir.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace daumier {
namespace {

using ::testing::HasSubstr;
using testing::TempDir;

std::string LoadFailure(const std::filesystem::path& path, const std::vector<std::string>& overrides = {}) {
  try {
    LoadConfig(path, overrides);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Config, ReadsTablesListsAndScalarsInTheirOrder) {
  const TempDir dir;
  WriteFileAtomically(dir / "a.toml", "zeta = 1\nbeta = [0.5, 1.5]\nname = 'x'\n[table]\nyes = true\nb.c = -2\n");
  EXPECT_EQ(LoadConfig(dir / "a.toml").dump(),
            R"({"zeta":1,"beta":[0.5,1.5],"name":"x","table":{"yes":true,"b":{"c":-2}}})");
}

TEST(Config, EmptyPathStartsFromNothing) {
  EXPECT_EQ(LoadConfig("").dump(), "{}");
  EXPECT_EQ(LoadConfig("", {"a.b=1"}).dump(), R"({"a":{"b":1}})");
}

TEST(Config, ParentsAreOverriddenKeyByKey) {
  const TempDir dir;
  MakeDirectory(dir / "base");
  WriteFileAtomically(dir / "base/root.toml", "a = 1\nb = [1, 2]\n[t]\nx = 1\ny = 2\n");
  WriteFileAtomically(dir / "base/middle.toml", "parent = 'root.toml'\na = 2\n");
  WriteFileAtomically(dir / "child.toml", "parent = 'base/middle.toml'\nb = [3]\n[t]\ny = 3\nz = 4\n");
  EXPECT_EQ(LoadConfig(dir / "child.toml").dump(), R"({"a":2,"b":[3],"t":{"x":1,"y":3,"z":4}})");
}

TEST(Config, OverridesReplaceSingleKeys) {
  const TempDir dir;
  WriteFileAtomically(dir / "a.toml", "[t]\nx = 1\ny = 2\n");
  EXPECT_EQ(LoadConfig(dir / "a.toml", {"t.y=5", "t.y=6", "u=true"}).dump(), R"({"t":{"x":1,"y":6},"u":true})");
}

TEST(Config, OverrideValuesAreTomlElseText) {
  const Json config = LoadConfig("", {"a=1", "b=0.5", "c=true", "d=word", "e=[1, 2]", "f='two words'", "g=two words",
                                      "h=", "i=2026-01-02", "j=runs/x.toml", "k=a=b", "l={m = 1}", "n=1\n2"});
  EXPECT_EQ(config.dump(), R"({"a":1,"b":0.5,"c":true,"d":"word","e":[1,2],"f":"two words","g":"two words","h":"",)"
                           R"("i":"2026-01-02","j":"runs/x.toml","k":"a=b","l":{"m":1},"n":"1\n2"})");
}

TEST(Config, BadOverridesAreNamed) {
  EXPECT_EQ(LoadFailure("", {"word"}), "override 'word' is not of the form key=value");
  EXPECT_EQ(LoadFailure("", {"/"}),
            "override '/' is not of the form key=value. A file or folder follows its key, as in faces=FOLDER");
  EXPECT_EQ(LoadFailure("", {"=1"}), "override '=1': '' is no key");
  EXPECT_EQ(LoadFailure("", {"a..b=1"}), "override 'a..b=1': '' is no key");
  EXPECT_EQ(LoadFailure("", {"a=1", "a.b=2"}), "override 'a.b=2': 'a' is no table");
  EXPECT_THAT(LoadFailure("", {"a=[1, 2"}), HasSubstr("override 'a=[1, 2': "));
}

TEST(Config, MissingFileIsNamed) {
  const TempDir dir;
  EXPECT_EQ(LoadFailure(dir / "absent.toml"),
            "cannot read " + (dir / "absent.toml").string() + ": No such file or directory");
}

TEST(Config, SyntaxErrorsNameFileLineAndCause) {
  const TempDir dir;
  WriteFileAtomically(dir / "a.toml", "a = 1\nb = = 2\n");
  EXPECT_THAT(LoadFailure(dir / "a.toml"), HasSubstr((dir / "a.toml").string() + ":2: "));
  WriteFileAtomically(dir / "a.toml", "a = 1\n\na = 2\n");
  EXPECT_THAT(LoadFailure(dir / "a.toml"), HasSubstr((dir / "a.toml").string() + ":3: "));
  WriteFileAtomically(dir / "a.toml", "\nwhen = 2026-01-02\n");
  EXPECT_THAT(LoadFailure(dir / "a.toml"), HasSubstr((dir / "a.toml").string() + ":2: dates and times are not used"));
}

TEST(Config, DeepKeysAreRefusedBeforeTheyAreParsed) {
  const TempDir dir;
  std::string key = "a";
  for (int i = 0; i < 200; ++i) key += ".a";
  WriteFileAtomically(dir / "a.toml", "b = 1\n[" + key + "]\n");
  EXPECT_EQ(LoadFailure(dir / "a.toml"), (dir / "a.toml").string() + ": line 2: a key has more than 100 dots");
  EXPECT_THAT(LoadFailure("", {key + "=1"}), HasSubstr("a key has more than 100 dots"));
  EXPECT_THAT(LoadFailure("", {"b={" + key + "=1}"}), HasSubstr("a key has more than 100 dots"));
  EXPECT_LT(LoadFailure("", {key + "=1"}).size(), 100u) << "the key is not repeated";
}

TEST(Config, BadParentsNameFileAndLine) {
  const TempDir dir;
  const std::string path = (dir / "a.toml").string();
  WriteFileAtomically(path, "x = 1\nparent = 'absent.toml'\n");
  EXPECT_EQ(LoadFailure(path), path + ":2: parent " + (dir / "absent.toml").string() + " does not exist");
  WriteFileAtomically(path, "parent = 3\n");
  EXPECT_EQ(LoadFailure(path), path + ":1: 'parent' has to be a file name in quotes");
}

TEST(Config, CyclicParentsAreRefused) {
  const TempDir dir;
  WriteFileAtomically(dir / "a.toml", "parent = 'b.toml'\n");
  WriteFileAtomically(dir / "b.toml", "parent = './a.toml'\n");
  EXPECT_THAT(LoadFailure(dir / "a.toml"), HasSubstr("is its own parent"));
}

TEST(Config, SurvivesTruncationAndFlippedBytes) {
  const TempDir dir;
  const std::string text =
      "a = 1 # note\nb = [0.5, 1e3, -inf]\nname = \"x\\u00e4\"\n[table.inner]\nyes = true\nb.c = -0x2f\n[[list]]\n"
      "k = '''lines\n'''\n[[list]]\nwhen = {d = 2_000}\n";
  const auto load = [&] { LoadConfig(dir / "a.toml"); };
  EXPECT_GT(testing::CountRefusedTruncations(dir / "a.toml", text, load), 50);
  Rng rng(1);
  EXPECT_GT(testing::CountRefusedFlips(dir / "a.toml", text, 300, rng, load), 100);
}

TEST(Config, LoadUndoesToToml) {
  Json config;
  config["z"] = 1;
  config["table"]["inner"]["pi"] = 3.141592653589793;
  config["table"]["empty"] = Json::object();
  config["table"]["list"] = Json::array();
  config["whole"] = 2.0;
  config["small"] = -1e-300;
  config["text"] = "quote \" backslash \\ newline \n tab \t bell \x07 umlaut \xc3\xa4";
  config["odd key.\""] = {true, false};
  config["mixed"] = {{{"a", 1}, {"b", {-1, 2}}}, {{"a", 2}}};
  config["after"] = 9007199254740993;
  config["inf"] = std::numeric_limits<double>::infinity();
  const TempDir dir;
  WriteFileAtomically(dir / "a.toml", ToToml(config));
  const Json again = LoadConfig(dir / "a.toml");
  EXPECT_EQ(again, config) << ToToml(config);
  EXPECT_EQ(again["inf"], config["inf"]);
  EXPECT_TRUE(again["whole"].is_number_float());
}

TEST(Config, TomlHasALineAValueUnderItsDottedKey) {
  EXPECT_EQ(ToToml(LoadConfig("", {"t.b=[1, 'x']", "t.a=0.5"})), "t.b = [1, \"x\"]\nt.a = 0.5\n");
}

TEST(Config, ToTomlRefusesWhatTomlCannotSay) {
  EXPECT_THROW(ToToml(Json{{"a", nullptr}}), Error);
  EXPECT_THROW(ToToml(Json{{"a", UINT64_MAX}}), Error);
  EXPECT_THROW(ToToml(Json::array()), Error);
}

}  // namespace
}  // namespace daumier
