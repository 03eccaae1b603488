#include "studio/verb_run.h"

#include "core/files.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::studio {
namespace {

std::string LineOf(const std::string& value) {
  VerbRun run({"rig", "face.obj"});
  run.Add("--hair-colour", value);
  return run.CommandLine();
}

TEST(VerbRun, WordsAreQuotedAsAShellReadsThem) {
  const std::string begin = "daumier rig face.obj --hair-colour ";
  EXPECT_EQ(LineOf("brown"), begin + "brown");
  EXPECT_EQ(LineOf(""), begin + "''");
  EXPECT_EQ(LineOf("rgb(1, 2, 3)"), begin + "'rgb(1, 2, 3)'");
  EXPECT_EQ(LineOf("it's; rm -rf ~"), begin + "'it'\\''s; rm -rf ~'");
  EXPECT_EQ(LineOf("$(id)"), begin + "'$(id)'");
  EXPECT_EQ(LineOf("a\nb"), begin + "'a\nb'");
}

TEST(VerbRun, AFlagIsThereIfItIsSet) {
  VerbRun run({"rig"});
  run.AddFlag("--vrm", true);
  run.AddFlag("--print", false);
  EXPECT_EQ(run.CommandLine(), "daumier rig --vrm");
}

TEST(VerbRun, ReturnsWhatIsPrintedOrThrowsItsLastLine) {
  const testing::TempDir folder;
  const auto run = [&](const char* program, const char* words) {
    return VerbRun({"-c", words}).Run(program, folder.path(), folder.path(), Task());
  };
  EXPECT_EQ(run("/bin/sh", "echo made"), "made\n");
  testing::ExpectError([&] { run("/bin/sh", "echo 'daumier: the neck is short' >&2; exit 1"); }, "the neck is short");
  testing::ExpectError([&] { run("/bin/sh", "exit 3"); }, "the program ended without a result");
  testing::ExpectError([&] { run("/nonexistent/daumier", ""); }, "is not there any more. Start the studio again");
}

TEST(VerbRun, CopiesDoNotTakeTheNamesOfResults) {
  EXPECT_EQ(NameOfCopy("/somewhere/woman.jpg"), "woman.jpg");
  for (const char* name : {"head.glb", "stages", "face.obj", "drawing.svg"})
    EXPECT_EQ(NameOfCopy(std::string("/somewhere/") + name), std::string("input_") + name);
  const testing::TempDir folder, other;
  WriteFileAtomically(other / "head.png", "picture");
  CopyInto(folder.path(), other / "head.png");
  EXPECT_EQ(ReadFile(folder / "input_head.png"), "picture");
}

}  // namespace
}  // namespace daumier::studio
