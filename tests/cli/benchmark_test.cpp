// `daumier benchmark` and `daumier score --benchmark` as their users run them, on a kit of four persons.
#include "core/files.h"
#include "core/json.h"
#include "tests/cli/pipeline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

namespace daumier::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// Made once of the repository's own definition and face model.
class BenchmarkCommand : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TempDir;
    made_ = Daumier({"benchmark", "make", "--config", Definition(), "--persons", "4", "--out", Kit()});
  }
  static void TearDownTestSuite() { delete folder_; }
  static std::string Definition() { return (SourceRoot() / "configs/benchmark/benchmark-1.toml").string(); }
  static std::string Kit() { return (*folder_ / "kit").string(); }
  static std::string In(const std::string& name) { return (*folder_ / name).string(); }

  static inline TempDir* folder_ = nullptr;
  static inline ProcessResult made_;
};

TEST_F(BenchmarkCommand, MakesAndChecksASmallKit) {
  ASSERT_EQ(made_.exit_code, 0) << made_.err;
  EXPECT_THAT(made_.out, HasSubstr("benchmark-1-of-4-persons, 4 persons"));
  const ProcessResult check = Daumier({"benchmark", "check", Kit(), "--against", Kit(), "--json"});
  ASSERT_EQ(check.exit_code, 0) << check.err;
  const Json result = Json::parse(check.out);
  EXPECT_EQ(result.at("against").at("same"), 4 * 8);
  EXPECT_THAT(ReadFile(In("kit/README.md")), HasSubstr("MIT License"));
}

/// By the names of the files alone, as a third party sees them.
TEST_F(BenchmarkCommand, NoPersonHasFilesInTwoSplits) {
  std::map<std::string, std::set<std::string>> splits_of_person;
  for (const char* part : {"inputs", "truth"})
    for (const auto& entry : fs::recursive_directory_iterator(*folder_ / "kit" / part)) {
      const std::string name = entry.path().filename().string();
      if (!name.starts_with("person-")) continue;
      const std::string split = (++entry.path().lexically_relative(*folder_ / "kit").begin())->string();
      splits_of_person[name.substr(0, 10)].insert(split);
    }
  EXPECT_EQ(splits_of_person.size(), 4u);
  for (const auto& [person, splits] : splits_of_person) EXPECT_EQ(splits.size(), 1u) << person;
}

TEST_F(BenchmarkCommand, ScoresABaseline) {
  ASSERT_EQ(Daumier({"benchmark", "baseline", Kit(), "--task", "caricatures", "--method", "mean", "--out", In("mean")})
                .exit_code,
            0);
  const ProcessResult json = Daumier({"score", In("mean"), "--benchmark", Kit(), "--task", "caricatures", "--json"});
  ASSERT_EQ(json.exit_code, 0) << json.err;
  const Json row = Json::parse(json.out);
  EXPECT_EQ(row.at("num_items"), 2);
  EXPECT_GT(row.at("vertex_error_mm").at("mean").get<double>(), 1);
  EXPECT_LE(row.at("surface_error_mm").at("mean").get<double>(), row.at("vertex_error_mm").at("mean").get<double>());
  EXPECT_EQ(row.at("method").at("name"), "mean");
  fs::remove(In("mean") + "/person-003-a.ply");
  const ProcessResult text = Daumier({"score", In("mean"), "--benchmark", Kit(), "--task", "caricatures"});
  EXPECT_THAT(text.out, AllOf(HasSubstr("vertices, mm"), HasSubstr("2 items, 1 without a prediction")));
  EXPECT_THAT(text.err, HasSubstr("1 of 2 items have no prediction"));
}

TEST_F(BenchmarkCommand, SaysWhatIsMissing) {
  const ProcessResult no_task = Daumier({"score", In("kit"), "--benchmark", Kit()});
  EXPECT_EQ(no_task.exit_code, 2);
  EXPECT_THAT(no_task.err, HasSubstr("--benchmark needs --task, one of drawings, caricatures, portraits, landmarks"));
  const ProcessResult empty = Daumier({"score", In("kit"), "--benchmark", Kit(), "--task", "landmarks"});
  EXPECT_EQ(empty.exit_code, 1);
  EXPECT_EQ(
      Daumier({"benchmark", "baseline", Kit(), "--task", "drawing", "--method", "mean", "--out", In("a")}).exit_code,
      2);
  EXPECT_EQ(Daumier({"benchmark", "check", In("absent")}).exit_code, 1);
  fs::copy(Kit(), In("changed"), fs::copy_options::recursive);
  WriteFileAtomically(In("changed") + "/landmarks.txt", "1\n");
  const ProcessResult changed = Daumier({"benchmark", "check", In("changed")});
  EXPECT_EQ(changed.exit_code, 1);
  EXPECT_THAT(changed.out, HasSubstr("changed: landmarks.txt"));
  EXPECT_THAT(changed.err, HasSubstr("0 files are missing, 1 changed"));
}

}  // namespace
}  // namespace daumier::testing
