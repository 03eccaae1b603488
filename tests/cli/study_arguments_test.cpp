// `daumier studio --collect` and `--study` as their users start them wrongly; what they do is tested without sockets (tests/studio).
#include "core/files.h"
#include "tests/cli/pipeline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace daumier::testing {
namespace {

using ::testing::HasSubstr;

class StudyModes : public ::testing::Test {
 protected:
  StudyModes() {
    MakeDirectory(folder_ / "items");
    MakeDirectory(folder_ / "mine");
    WriteFileAtomically(folder_ / "mine/notes.txt", "mine");
  }
  std::string In(const std::string& name) const { return (folder_ / name).string(); }
  void ExpectMisuse(std::vector<std::string> options, const std::string& part) const {
    options.insert(options.begin(), {"studio", "--no-browser"});
    const ProcessResult result = Daumier(options);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_THAT(result.err, HasSubstr(part));
  }
  const TempDir folder_;
};

TEST_F(StudyModes, OptionsHaveToFitTheMode) {
  ExpectMisuse({"--collect", In("items"), "--study", In("items"), "--out", In("x")}, "--collect excludes --study");
  ExpectMisuse({"--collect", In("items")}, "--out DIR");
  ExpectMisuse({"--study", In("items")}, "--out votes.csv");
  ExpectMisuse({"--person", "3"}, "belong to --collect or --study");
  ExpectMisuse({"--study", In("items"), "--out", In("v.csv"), "--count", "3"}, "--count requires --collect");
  ExpectMisuse({"--collect", In("items"), "--out", In("x"), "--vote", "best"}, "--vote requires --study");
  ExpectMisuse({"--study", In("items"), "--out", In("v.csv"), "--vote", "worst"}, "worst");
  ExpectMisuse({"--study", In("items"), "--live-link", "11111"}, "--live-link excludes --study");
  ExpectMisuse({"--live-link", "phone:11111", "--folder", In("new")}, "'phone:11111' is no place to receive at");
  ExpectMisuse({"--collect", In("absent"), "--out", In("x")}, "absent");
}

TEST_F(StudyModes, FoldersOfOtherThingsStayAsTheyAre) {
  ExpectMisuse({"--collect", In("items"), "--out", In("mine")}, "holds no earlier collection");
  EXPECT_EQ(ReadFile(folder_ / "mine/notes.txt"), "mine");
  ExpectMisuse({"--collect", In("items"), "--out", In("new")}, "neither a face nor a mesh");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "new"));
}

}  // namespace
}  // namespace daumier::testing
