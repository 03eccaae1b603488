#include "core/files.h"
#include "tests/cli/pipeline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace daumier::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(ConfigOfAnotherCommand, IsNamedWithTheCommandThatReadsIt) {
  const TempDir folder;
  const std::string out = folder / "out";
  const auto config = [](const char* name) { return (SourceRoot() / "configs" / name).string(); };
  const std::string faces = config("faces/demo.toml"), sketches = config("sketches/frontal.toml"),
                    training = config("sketch/demo.toml"), table = config("sketch/ablation_cpu.toml"),
                    deform = config("deform/cpu.toml");
  const auto expect = [&](std::vector<std::string> arguments, const std::string& file, const std::string& right) {
    arguments.insert(arguments.end(), {"--out", out});
    const ProcessResult result = Daumier(arguments);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err,
                AllOf(HasSubstr(file + " is a config of `daumier " + right + "`"), HasSubstr("Try daumier")))
        << arguments[0];
    EXPECT_LT(result.err.size(), 600u) << "without a list of all keys";
    EXPECT_FALSE(std::filesystem::exists(out));
  };
  expect({"train", faces}, faces, "dataset faces");
  expect({"train", sketches}, sketches, "dataset sketches");
  expect({"train", table}, table, "ablate");
  expect({"dataset", "faces", "--config", training}, training, "train");
  expect({"dataset", "sketches", "--config", deform}, deform, "train");
  expect({"dataset", "points", "--config", table}, table, "ablate");
}

TEST(ConfigOfAnotherCommand, AMisspeltKeyOfTheRightOneIsAnErrorAboutTheKey) {
  const TempDir folder;
  WriteFileAtomically(folder / "faces.toml", "num_person = 3\n");
  const ProcessResult result =
      Daumier({"dataset", "faces", "--config", folder / "faces.toml", "--out", folder / "out"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("did you mean 'num_persons'?"));
}

}  // namespace
}  // namespace daumier::testing
